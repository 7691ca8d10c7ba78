"""Frames of other renderers: handed in as a file, or rendered by a command, and judged like our own."""
