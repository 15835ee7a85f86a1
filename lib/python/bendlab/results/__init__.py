"""Run files: the figures read them, and so may everybody."""
