"""The effects: one folder each, discovered, never listed."""
