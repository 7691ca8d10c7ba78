"""Reports: results as JSON, HTML, heatmaps and JUnit XML."""
