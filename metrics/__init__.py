"""Metrics: how far one image is from another, and how sure that is."""
