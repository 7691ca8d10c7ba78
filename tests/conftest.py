"""Plugins for all tests: pytest wants them named in the topmost conftest."""

pytest_plugins = ["pytester"]
