"""What effects for dielectric solids share: what is seen around them, their backs, their shape from within."""
