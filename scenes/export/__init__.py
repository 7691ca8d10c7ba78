"""A scene as other engines read it: glTF 2.0, and a JSON document with the camera and every convention.

What comes out is in memory; whoever calls writes the files.
"""

from .camera import ENVIRONMENT_FILE, camera_document
from .gltf import GltfFiles, gltf_files

__all__ = ["ENVIRONMENT_FILE", "GltfFiles", "camera_document", "gltf_files"]
