"""The ground truth: references and oracles, path traced with Mitsuba.

Importing this package imports no Mitsuba. What needs none either: `batches` (references from the store), `store`,
`folder`, `recall`, `content`, `variant`, and the oracles `tone`, `encode`, `coverage`. Everything else sets Mitsuba's
variant when it is imported, or raises `variant.NoRendererError`.
"""
