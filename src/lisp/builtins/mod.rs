//! The builtin functions: one table per topic.

pub mod calls;
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
pub mod shown;
