"""What `lightmeter doctor` examines a machine by: findings, child processes, both renderers, remedies."""
