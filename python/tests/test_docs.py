import re
from pathlib import Path

PAGE = Path(__file__).parents[2] / "docs" / "python.md"


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
