//! The language without robots.

mod array_elements;
mod arrays;
mod builtin_robustness;
mod cram_utilities;
mod debugger_and_packages;
mod examples;
mod files;
mod formatters;
mod generic_functions;
mod gray_streams;
mod library;
mod limits;
mod macros;
mod metaobjects;
mod method_combinations;
mod pathnames;
mod pretty_printer;
mod printing;
mod reader_round_trip;
mod reading;
mod readtables;
mod redefined_classes;
mod restarts;
mod standard;
mod type_specifiers;
