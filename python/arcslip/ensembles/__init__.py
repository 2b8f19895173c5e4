"""Ensembles: a study for many samples of parameters."""
