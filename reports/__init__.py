"""Reports: results as JSON, HTML, heatmaps, layered EXR and JUnit XML.

Nothing is imported here: `lightmeter.reports.results` needs only the standard library, and a command that
prints a table should not pay for OpenEXR or Pillow.
"""
