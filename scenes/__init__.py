"""Scenes: what is to be rendered, with no renderer's types in it."""
