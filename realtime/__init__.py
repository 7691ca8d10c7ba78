"""The real-time renderer: frame graph, shared shaders and the effects."""
