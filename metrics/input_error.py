"""The one error that this package raises for input that cannot be compared."""


class InputError(ValueError):
    """Input that cannot be measured, with what is wrong and how to mend it.

    Attributes:
        what: what is wrong, in one clause.
        expected: what was expected.
        actual: what was given.
        remedy: what the caller can do about it.
    """

    def __init__(self, what: str, *, expected: str, actual: str, remedy: str) -> None:
        self.what = what
        self.expected = expected
        self.actual = actual
        self.remedy = remedy
        super().__init__(f"{what}: expected {expected}, got {actual}. {remedy}")
