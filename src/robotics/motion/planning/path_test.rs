//! What a search for a path asks of whoever knows what is in the way.

/// Tells which configurations are free.
pub(crate) trait PathTest<P> {
    /// What blocks a configuration, if anything does.
    fn obstacle(&mut self, configuration: &[f64]) -> Option<P>;

    /// Whether nothing does, which may be found out faster.
    fn is_free(&mut self, configuration: &[f64]) -> bool {
        self.obstacle(configuration).is_none()
    }
}

impl<P, F: FnMut(&[f64]) -> Option<P>> PathTest<P> for F {
    fn obstacle(&mut self, configuration: &[f64]) -> Option<P> {
        self(configuration)
    }
}
