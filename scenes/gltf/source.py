"""A checked document with what it refers to: lookups that name what is missing, and bytes that are really there."""

import base64
import binascii
from collections.abc import Sequence
from typing import TypeVar
from urllib.parse import unquote

from pydantic import BaseModel, ValidationError

from lightmeter.scenes.errors import SceneError, shown
from lightmeter.scenes.files import inside, read_bytes
from lightmeter.scenes.gltf.container import Container
from lightmeter.scenes.gltf.document import Document, Part
from lightmeter.scenes.validation import explain

Found = TypeVar("Found")
Extension = TypeVar("Extension", bound=BaseModel)


class Source:
    """One glTF file, open.

    Attributes:
        document: its checked JSON.
        where: the file, for messages.
        notes: what was decided or left out while reading; each once.
    """

    def __init__(self, container: Container):
        self.where = container.where
        self.notes: list[str] = []
        self._container = container
        self._buffers: dict[int, memoryview] = {}
        try:
            self.document = Document.model_validate(container.content)
        except ValidationError as error:
            raise explain(error, container.content, self.where) from None

    def note(self, text: str) -> None:
        """Adds a note, unless it is there already."""
        if text not in self.notes:
            self.notes.append(text)

    def at(self, place: str) -> str:
        """`place` in this file, for messages."""
        return f"{self.where}: {place}"

    def get(self, kind: str, items: Sequence[Found], index: int, place: str) -> Found:
        """`items[index]`.

        Raises:
            SceneError: there is no such item.
        """
        if index >= len(items):
            raise SceneError(
                f"there is no {kind}[{index}]",
                where=self.at(place),
                expected=f"0 to {len(items) - 1}" if items else f"{kind} to be there",
                actual=f"{index}",
            )
        return items[index]

    def extension(self, part: Part, name: str, kind: type[Extension], place: str) -> Extension | None:
        """The extension `name` of `part`, checked, or None.

        Raises:
            SceneError: it is there and wrong.
        """
        content = part.extensions.get(name)
        if content is None:
            return None
        try:
            return kind.model_validate(content)
        except ValidationError as error:
            raise explain(error, content, self.at(f"{place}.extensions.{name}")) from None

    def fetch(self, uri: str, place: str) -> bytes:
        """The bytes at a data URI or of a file beside this one.

        Raises:
            SceneError: the URI is damaged, leads elsewhere, or the file is missing.
        """
        if uri.startswith("data:"):
            head, comma, body = uri.partition(",")
            try:
                if not comma or not head.endswith(";base64"):
                    raise ValueError
                return base64.b64decode(body, validate=True)
            except (ValueError, binascii.Error):
                raise SceneError(
                    "the data URI is damaged",
                    where=self.at(place),
                    expected="data:…;base64,…",
                    actual=shown(uri[:60]),
                ) from None
        path = inside(self._container.path.parent, unquote(uri), self.at(place))
        return read_bytes(path, where=self.at(place))

    def buffer(self, index: int, place: str) -> memoryview:
        """The bytes of a buffer, as many as it says it has.

        Raises:
            SceneError: it is missing, or holds fewer.
        """
        if index not in self._buffers:
            buffer = self.get("buffers", self.document.buffers, index, place)
            here = f"buffers[{index}]"
            if buffer.uri is not None:
                data = memoryview(self.fetch(buffer.uri, f"{here}.uri"))
            elif index == 0 and self._container.binary is not None:
                data = self._container.binary
            else:
                raise SceneError(
                    "the buffer has no uri",
                    where=self.at(here),
                    remedy="only the first buffer of a .glb with a binary chunk may have none",
                )
            if len(data) < buffer.byte_length:
                raise SceneError(
                    "the buffer is truncated",
                    where=self.at(here),
                    expected=f"{buffer.byte_length} bytes",
                    actual=f"{len(data)}",
                )
            self._buffers[index] = data[: buffer.byte_length]
        return self._buffers[index]

    def view(self, index: int, place: str) -> tuple[memoryview, int | None]:
        """The bytes of a buffer view, and its stride.

        Raises:
            SceneError: it reaches beyond its buffer.
        """
        view = self.get("bufferViews", self.document.buffer_views, index, place)
        here = f"bufferViews[{index}]"
        data = self.buffer(view.buffer, f"{here}.buffer")
        end = view.byte_offset + view.byte_length
        if end > len(data):
            raise SceneError(
                "the view reaches beyond its buffer",
                where=self.at(here),
                expected=f"an end of at most {len(data)} bytes",
                actual=f"{end}",
            )
        return data[view.byte_offset : end], view.byte_stride
