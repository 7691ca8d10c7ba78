"""What a scene's materials and lights mean, written once for both renderers.

The functions are generic: they take float64 (or float32) NumPy arrays as well as Dr.Jit arrays. A vector or a
colour has its components first, (3, N) in NumPy and `Color3f`, `Vector3f` in Dr.Jit, so that the same line of code
multiplies a colour with a scalar in both. Directions are unit vectors that point away from the surface.
GLSL is held against these functions, and they against closed forms, quadrature and chi².
"""
