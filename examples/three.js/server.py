"""A server on this machine alone: the page, three.js and the exported scene; it takes what the page sends back."""

import contextlib
import functools
import queue
import threading
from collections.abc import Iterator, Mapping
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from urllib.parse import unquote, urlsplit


class Handler(SimpleHTTPRequestHandler):
    """Serves files below some folders, each under a prefix of its own."""

    extensions_map = {**SimpleHTTPRequestHandler.extensions_map, ".mjs": "text/javascript"}  # noqa: RUF012

    def __init__(self, *arguments, places: Mapping[str, Path], answers: queue.Queue) -> None:
        self._places, self._answers = places, answers
        super().__init__(*arguments)

    def translate_path(self, path: str) -> str:
        """The file of a path; of the longest prefix that fits, and never outside its folder."""
        asked = unquote(urlsplit(path).path)
        prefix = max((p for p in self._places if asked.startswith(p)), key=len)
        place = self._places[prefix].resolve()
        found = (place / asked.removeprefix(prefix)).resolve()
        return str(found if found.is_relative_to(place) else place / "outside")

    def do_POST(self) -> None:
        """Hand (path, body) on."""
        body = self.rfile.read(int(self.headers["Content-Length"]))
        self._answers.put((self.path, body))
        self.send_response(204)
        self.end_headers()

    def log_message(self, *_) -> None:
        """Nothing: requests are of no interest."""


@contextlib.contextmanager
def serve(places: Mapping[str, Path]) -> Iterator[tuple[str, queue.Queue]]:
    """The server's address, and the queue of what was posted, as (path, body).

    Args:
        places: prefixes to folders or files; "/" has to be among them.
    """
    answers: queue.Queue = queue.Queue()
    handler = functools.partial(Handler, places=places, answers=answers)
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        thread = threading.Thread(target=server.serve_forever, daemon=True)
        thread.start()
        try:
            yield f"http://127.0.0.1:{server.server_port}", answers
        finally:
            server.shutdown()
            thread.join()
