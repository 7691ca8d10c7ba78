"""What shadow techniques share: where a light's maps look from, how casters are drawn into them, their knobs."""
