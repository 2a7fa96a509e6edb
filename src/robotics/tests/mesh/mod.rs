mod broken;
mod formats;
mod memory_files;
mod places;
mod solids;
