"""Which exceptions are the user's to mend: they end a command with one message and exit code 2, not a traceback."""

import sys

USAGE_ERROR = 2
"""The exit code of a command that ends with such a message."""

KNOWN = (
    ("lightmeter.scenes.errors", "SceneError"),
    ("lightmeter.realtime.effect", "EffectError"),
    ("lightmeter.realtime.device", "DeviceError"),
    ("lightmeter.groundtruth.variant", "NoRendererError"),
    ("lightmeter.groundtruth.folder", "ReferenceFolderError"),
    ("lightmeter.metrics.input_error", "InputError"),
    ("lightmeter.scenes.image_files.image_error", "ImageError"),
    ("lightmeter.reports.results_json", "ResultsError"),
)


class UsageError(ValueError):
    """A word on the command line or in lightmeter.toml that is wrong; the message says what is right."""


def user_failures() -> tuple[type[BaseException], ...]:
    """The exception classes, of those modules that are loaded: what is not loaded cannot have been raised."""
    found: list[type[BaseException]] = [UsageError, OSError]
    for module, name in KNOWN:
        loaded = sys.modules.get(module)
        if loaded is not None and hasattr(loaded, name):
            found.append(getattr(loaded, name))
    return tuple(found)


def explain(error: BaseException) -> str:
    """The error as one message; the system's own errors without their numbers."""
    if isinstance(error, OSError) and error.strerror:
        return f"{error.filename}: {error.strerror}" if error.filename else error.strerror
    return str(error)
