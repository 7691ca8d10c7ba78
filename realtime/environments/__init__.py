"""What techniques for environment maps share: the map as a cube, lobes baked over cubes, sums over the sphere."""
