"""Writes small glTF files for the tests, valid unless a test spoils them."""

import base64
import json
import struct
from pathlib import Path
from typing import Any

import numpy as np

TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}
COMPONENTS = {"i1": 5120, "u1": 5121, "i2": 5122, "u2": 5123, "u4": 5125, "f4": 5126}
QUAD = np.float32([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
QUAD_UV = np.float32([[0, 1], [1, 1], [1, 0], [0, 0]])
UP = np.float32([[0, 0, 1]] * 4)
TWO = np.uint16([0, 1, 2, 0, 2, 3])


class Writer:
    """A glTF document that grows; `content` may be changed freely before it is saved."""

    def __init__(self):
        self.binary = bytearray()
        self.content: dict[str, Any] = {
            "asset": {"version": "2.0"},
            "scene": 0,
            "scenes": [{"nodes": []}],
            "nodes": [],
            "meshes": [],
            "accessors": [],
            "bufferViews": [],
            "buffers": [{}],
        }

    def view(self, data: bytes, **keys: Any) -> int:
        self.binary += b"\0" * (-len(self.binary) % 4)
        views = self.content["bufferViews"]
        views.append({"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data), **keys})
        self.binary += data
        return len(views) - 1

    def accessor(self, values: np.ndarray, **keys: Any) -> int:
        table = values.reshape(len(values), -1)
        entry = {
            "bufferView": self.view(table.tobytes()),
            "componentType": COMPONENTS[values.dtype.str[1:]],
            "count": len(table),
            "type": TYPES[table.shape[1]],
        }
        self.content["accessors"].append(entry | keys)
        return len(self.content["accessors"]) - 1

    def mesh(self, indices: np.ndarray | None = TWO, material: dict | None = None, **attributes: Any) -> int:
        attributes = attributes or {"POSITION": QUAD, "NORMAL": UP, "TEXCOORD_0": QUAD_UV}
        primitive: dict[str, Any] = {
            "attributes": {
                name: self.accessor(values) if isinstance(values, np.ndarray) else values
                for name, values in attributes.items()
            }
        }
        if indices is not None:
            primitive["indices"] = self.accessor(indices)
        if material is not None:
            materials = self.content.setdefault("materials", [])
            primitive["material"] = len(materials)
            materials.append(material)
        self.content["meshes"].append({"primitives": [primitive]})
        return len(self.content["meshes"]) - 1

    def node(self, *, root: bool = True, **keys: Any) -> int:
        self.content["nodes"].append(keys)
        index = len(self.content["nodes"]) - 1
        if root:
            self.content["scenes"][0]["nodes"].append(index)
        return index

    def texture(self, png: bytes, **sampler: Any) -> int:
        images = self.content.setdefault("images", [])
        images.append({"bufferView": self.view(png), "mimeType": "image/png"})
        entry = {"source": len(images) - 1}
        if sampler:
            samplers = self.content.setdefault("samplers", [])
            samplers.append(sampler)
            entry["sampler"] = len(samplers) - 1
        textures = self.content.setdefault("textures", [])
        textures.append(entry)
        return len(textures) - 1

    def finished(self, *, inline: bool) -> dict[str, Any]:
        buffer = self.content["buffers"][0] if self.content.get("buffers") else {}
        buffer.setdefault("byteLength", max(len(self.binary), 1))
        if inline:
            data = base64.b64encode(bytes(self.binary) or b"\0").decode()
            buffer.setdefault("uri", f"data:application/octet-stream;base64,{data}")
        return self.content

    def save(self, folder: Path, name: str = "scene.gltf") -> Path:
        path = folder / name
        if path.suffix == ".glb":
            path.write_bytes(glb(self.finished(inline=False), bytes(self.binary)))
        else:
            path.write_text(json.dumps(self.finished(inline=True)))
        return path


def glb(content: dict[str, Any], binary: bytes) -> bytes:
    text = json.dumps(content).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text
    chunks += struct.pack("<I4s", len(binary), b"BIN\0") + binary
    return b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks


def quad(**node: Any) -> Writer:
    """One square in z = 0 from (0, 0) to (1, 1), facing +Z."""
    writer = Writer()
    writer.node(mesh=writer.mesh(), **node)
    return writer


def png(texels: np.ndarray) -> bytes:
    """(H, W, C) uint8 as a PNG file."""
    import io

    from PIL import Image

    out = io.BytesIO()
    Image.fromarray(texels).save(out, "PNG")
    return out.getvalue()
