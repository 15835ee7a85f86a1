"""Reads run files. The figures use this package; other programs may use it, too."""
