"""Files: of results, of ensembles, and what stands in scenes in place of files."""
