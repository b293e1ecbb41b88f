import re
import subprocess
import sys
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[2] / "docs"
PAGE = DOCS / "python.md"


def test_the_code_of_the_page_runs_and_prints_what_the_page_says(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"```(python|text)\n(.*?)```", PAGE.read_text(), re.DOTALL)
    assert len(blocks) >= 6
    names = {}
    for kind, text in blocks:
        if kind == "text":
            assert printed == text
        else:
            exec(text, names)
            printed = capsys.readouterr().out
    assert names["found"].verdict == "refuted" and len(names["table"]) == 400
    assert (tmp_path / "found.jsonl").exists()


@pytest.mark.parametrize("engine", ["dask", "ray"])
def test_the_engine_of_the_page_makes_the_table_that_one_call_makes(tmp_path, engine):
    """Where the engine is installed, which the check does not do: both are large."""
    pytest.importorskip({"dask": "dask.distributed", "ray": "ray"}[engine])
    blocks = re.findall(r"```python\n(.*?)```", (DOCS / "dask-and-ray.md").read_text(), re.DOTALL)
    [own, *engines] = blocks
    [of_engine] = [block for block in engines if f"by_{engine}" in block]
    # As a script, since the engines start processes that read it, too; fewer seeds, so that it is soon done.
    script = (own + of_engine).replace("seeds=1000", "seeds=100")
    script += f"    assert by_{engine} == merged([part(range(100))]) and len(by_{engine}[1]) == 200\n"
    (tmp_path / "page.py").write_text(script)
    subprocess.run([sys.executable, "page.py"], cwd=tmp_path, check=True, timeout=300)
