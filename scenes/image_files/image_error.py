"""The one error that reading and writing images raises."""

import os


class ImageError(ValueError):
    """An image that cannot be read: what is wrong, where, what was expected, what was found, how to mend it."""

    def __init__(
        self,
        what: str,
        *,
        where: str | os.PathLike[str],
        expected: str = "",
        actual: str = "",
        remedy: str = "",
    ) -> None:
        self.what = what
        self.where = os.fspath(where)
        self.expected = expected
        self.actual = actual
        self.remedy = remedy
        facts = [f"expected {expected}" if expected else "", f"found {actual}" if actual else ""]
        message = f"{self.where}: {what}"
        if any(facts):
            message += ": " + ", ".join(fact for fact in facts if fact)
        super().__init__(message + (f". {remedy}" if remedy else ""))
