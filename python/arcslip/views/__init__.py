"""Results as data frames, figures and pages."""
