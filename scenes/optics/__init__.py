"""What a scene's materials and lights mean, written once for both renderers."""
