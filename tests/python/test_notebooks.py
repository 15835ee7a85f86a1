"""Each notebook runs from the first cell to the last, in an empty folder.

    test_notebooks.py PROGRAM [FOLDER]      FOLDER gets the executed notebooks
"""
import os
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import nbformat
    from nbclient import NotebookClient
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

NOTEBOOKS = Path(__file__).resolve().parents[2] / "analysis/notebooks"
KEPT = Path(sys.argv[2]).resolve() if len(sys.argv) > 2 else None
del sys.argv[1:]


class Notebooks(unittest.TestCase):
    def test_every_notebook_runs(self):
        paths = sorted(NOTEBOOKS.glob("*.ipynb"))
        self.assertEqual(len(paths), 2)
        with tempfile.TemporaryDirectory() as place:
            os.environ.update(IPYTHONDIR=place, JUPYTER_RUNTIME_DIR=place,
                              MPLBACKEND="module://matplotlib_inline.backend_inline")
            for path in paths:
                with self.subTest(path.name):
                    notebook = nbformat.read(path, as_version=4)
                    for cell in notebook.cells:
                        self.assertFalse(cell.get("outputs"), "a notebook is committed without outputs")
                    NotebookClient(notebook, timeout=300, kernel_name="python3",
                                   resources={"metadata": {"path": place}}).execute()
                    if KEPT:
                        nbformat.write(notebook, KEPT / path.name)
                    images = [output for cell in notebook.cells for output in cell.get("outputs", [])
                              if "image/png" in output.get("data", {})]
                    self.assertTrue(images, "a notebook draws at least one image")


if __name__ == "__main__":
    unittest.main()
