"""The oracles: one file per term, named after it."""
