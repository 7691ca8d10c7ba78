"""The ground truth: references and oracles, path traced with Mitsuba."""
