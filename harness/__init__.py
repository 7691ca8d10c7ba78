"""lightmeter: how far a real-time frame is from the light that physics would give."""
