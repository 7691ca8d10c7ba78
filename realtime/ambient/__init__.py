"""What effects for `environment_visibility` share: passes over the screen, knobs, what is hidden of a mirrored lobe."""
