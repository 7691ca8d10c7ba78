"""One device for all tests: a context takes longer to make than most tests to run."""

import pytest

from lightmeter.realtime.device import Device, DeviceError


@pytest.fixture(scope="session")
def device() -> Device:
    """The OpenGL device."""
    try:
        return Device()
    except DeviceError as error:
        pytest.skip(str(error))
