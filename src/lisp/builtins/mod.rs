//! The builtin functions: one table per topic.

pub mod array_index;
pub mod calls;
pub mod characters;
pub mod criterion;
pub mod keywords;
pub mod list_search;
pub mod list_sets;
pub mod list_trees;
pub mod lists;
pub mod mapping;
pub mod pairs;
pub mod property_lists;
pub mod sequence;
pub mod sequence_access;
pub mod sequence_change;
pub mod sequence_duplicates;
pub mod sequence_find;
pub mod sequence_map;
pub mod sequence_search;
pub mod sequence_types;
pub mod shown;
pub mod sort;
pub mod string_compare;
pub mod strings;
