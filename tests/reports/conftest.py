"""A browser for the pages, which complains and fetches nothing whatever a test does."""

from collections.abc import Iterator

import pytest

from .chromium_pipe import Page, open_chromium


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    """A tab that shows nothing yet."""
    with open_chromium(tmp_path_factory.mktemp("profile")) as page:
        yield page


@pytest.fixture(autouse=True)
def no_problems(request: pytest.FixtureRequest) -> Iterator[None]:
    """The console stays empty and nothing is fetched."""
    yield
    if "page" in request.fixturenames:
        page = request.getfixturevalue("page")
        problems, page.problems = page.problems, []
        assert problems == []
        assert [url for url in page.requests if not url.startswith(("file:", "data:", "about:", "blob:"))] == []
