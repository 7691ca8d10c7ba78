"""glTF 2.0: `.gltf` and `.glb` files.

The file is not trusted: its JSON is checked against a schema, and no number in it is believed before the bytes
that it speaks of are seen to be there.
"""

from lightmeter.scenes.gltf.assemble import load_gltf

__all__ = ["load_gltf"]
