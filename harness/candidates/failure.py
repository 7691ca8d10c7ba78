"""A candidate that gave no frame."""

from lightmeter.failures import UsageError


class CandidateError(UsageError):
    """A candidate's command failed, or its file cannot be judged; the message names it and says what it did last."""
