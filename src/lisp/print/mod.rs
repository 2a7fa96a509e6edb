//! To come.

#[cfg(test)]
pub(crate) mod test_image;
