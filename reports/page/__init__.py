"""The report's page: one template, its style sheet and its scripts, put into a single file by `reports.html`."""
