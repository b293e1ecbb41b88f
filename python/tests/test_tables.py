import duckdb
import pandas as pd
import polars as pl
import pyarrow as pa
import pytest

import pytautline as tautline


@pytest.fixture(scope="module")
def table():
    return tautline.sweep(
        ["open:7x7", "walls:7x7:0.2"], rules=["published", "repaired"], robots=[3, 4], seeds=range(5)
    )


def test_a_sweep_is_read_by_arrow_polars_and_pandas(table):
    assert len(table) == 40
    columns = table.to_dict()
    arrow = pa.table(table)
    assert arrow.column_names == table.columns
    assert arrow.to_pydict() == columns
    assert pl.DataFrame(table).to_dict(as_series=False) == columns
    frame = pd.DataFrame.from_arrow(table) if hasattr(pd.DataFrame, "from_arrow") else arrow.to_pandas()
    assert frame["steps"].tolist() == columns["steps"]
    # DuckDB finds the name in Python.
    arrow_table = pa.RecordBatchReader.from_stream(table)
    counted = duckdb.sql("select rule, robots, count(*), sum(steps)::bigint from arrow_table group by all order by all")
    frame = frame.groupby(["rule", "robots"])["steps"].agg(["count", "sum"])
    assert counted.fetchall() == [(*key, *row) for key, row in zip(frame.index, frame.values.tolist(), strict=True)]
    # A table is a stream as often as it is asked for.
    assert pa.table(table) == arrow


def test_each_row_is_a_run(table):
    columns = table.to_dict()
    assert columns["layout"] == ["open:7x7"] * 20 + ["walls:7x7:0.2"] * 20
    for row in (0, 13, 39):
        given = {name: values[row] for name, values in columns.items()}
        run = tautline.explore(
            given["layout"], rule=given["rule"], robots=given["robots"], seed=given["seed"]
        )
        assert (run.steps, run.explored, run.cells, run.stopped) == (
            given["steps"],
            given["explored"],
            given["cells"],
            given["stopped"],
        )
        assert run.milestones[100] == given["moves_100"]
        assert len(run.violations) == given["violations"]


def test_estimates_have_the_intervals_of_the_program():
    steps = tautline.estimate([1, 2, 3, 4])
    assert (steps.count, steps.mean) == (4, 2.5)
    low, high = steps.interval
    # Student's t of 3 degrees of freedom is 3.182.
    assert low + high == pytest.approx(5) and high - 2.5 == pytest.approx(2.0543, rel=1e-3)
    share = tautline.estimate_share(0, 100)
    assert share.mean == 0 and share.interval[0] == 0 and share.interval[1] == pytest.approx(0.0370, abs=1e-4)
    assert tautline.estimate([3]).interval is None
    assert tautline.estimate_ratio([(2, 1), (4, 2)]).mean == 2
    assert str(steps) == steps.text(2)
