"""What techniques for reflections share: knobs, what mirrors, and the cubes of what stands around."""
