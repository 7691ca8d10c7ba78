"""A kind of import-linter contract for a layer whose modules lie directly in the package.

import-linter's own layers want every module of a layer named. The harness's modules are not one package among
the five but the root they lie in, so they are what is left when the five are taken away.
"""

from grimp import ImportGraph
from importlinter import Contract, ContractCheck, fields, output


class RootOnTop(Contract):
    """No listed package imports the root package itself, or a module of it outside the listed packages."""

    root = fields.StringField()
    packages = fields.ListField(subfield=fields.StringField())

    def check(self, graph: ImportGraph, verbose: bool) -> ContractCheck:
        """Look at direct imports only: an indirect one goes through a direct one."""
        upward = [
            (importer, imported)
            for importer in sorted(graph.modules)
            if self._is_below(importer)
            for imported in sorted(graph.find_modules_directly_imported_by(importer))
            if self._is_on_top(imported)
        ]
        return ContractCheck(kept=not upward, metadata={"upward": upward})

    def render_broken_contract(self, check: ContractCheck) -> None:
        """One line for each import that points the wrong way."""
        for importer, imported in check.metadata["upward"]:
            output.print_error(f"{importer} imports {imported}, which lies above it")

    def _is_below(self, module: str) -> bool:
        return any(module == name or module.startswith(f"{name}.") for name in self.packages)

    def _is_on_top(self, module: str) -> bool:
        inside = module == self.root or module.startswith(f"{self.root}.")
        return inside and not self._is_below(module)
