"""Linear algebra of the likelihood and Gauss-Newton on the real simulation."""
