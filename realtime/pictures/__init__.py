"""Passes over a whole picture, for effects of the display chain, and their twins."""
