import numpy as np
import pytest

import pytautline as tautline
from pytautline import InputError, Layout


def test_a_generated_layout_comes_back_from_its_arrays():
    layout = Layout.load("walls:15x12:0.2", seed=3)
    blocked, east, south = (np.asarray(plane) for plane in (layout.blocked, layout.east, layout.south))
    assert blocked.shape == (12, 15) and blocked.dtype == bool
    assert east.sum() + south.sum() > 0
    again = Layout.from_arrays(blocked, east=east, south=south)
    assert again == layout and hash(again) == hash(layout)
    assert Layout.from_arrays(np.asfortranarray(blocked), east=east[:], south=south) == layout


def test_numbers_of_eight_bits_and_rows_of_python_are_arrays():
    cells = np.zeros((3, 4), np.uint8)
    cells[1, 2] = 1
    layout = Layout.from_arrays(cells, base=(0, 0), robots=2)
    assert (layout.width, layout.height, layout.base, layout.robots, layout.free_cells) == (4, 3, (0, 0), 2, 11)
    assert np.asarray(layout.blocked).sum() == 1
    assert layout == Layout.from_arrays(memoryview(cells), base=(0, 0), robots=2)
    assert Layout.parse(str(layout)) == layout
    assert (layout.beyond((1, 1), "E"), layout.beyond((1, 1), "N")) == (None, (1, 0))
    assert layout._repr_svg_().startswith("<svg ")


@pytest.mark.parametrize(
    ("array", "said"),
    [
        (np.zeros(4, bool), "1 dimensions"),
        (np.zeros((2, 2, 2), bool), "3 dimensions"),
        (np.zeros((2, 2), float), 'the format "d"'),
        ([[0, 1]], "no array"),
        (np.zeros((0, 3), bool), "3x0"),
    ],
)
def test_arrays_of_a_wrong_shape_are_refused_with_what_to_do(array, said):
    with pytest.raises(InputError) as refused:
        Layout.from_arrays(array)
    assert refused.value.remedy
    assert said in str(refused.value)


def test_walls_of_another_shape_are_refused():
    with pytest.raises(InputError, match="same shape"):
        Layout.from_arrays(np.zeros((2, 3), bool), east=np.zeros((3, 2), bool))


def test_what_cannot_be_loaded_is_refused_with_its_place(tmp_path):
    file = tmp_path / "layout.txt"
    file.write_text("tautline layout 1\n+--+\n|? |\n+--+\n")
    with pytest.raises(InputError, match=r"layout\.txt:3:") as refused:
        Layout.load(file)
    assert isinstance(refused.value, ValueError)
    with pytest.raises(InputError, match="walls"):
        Layout.load("walls:9x9")
    with pytest.raises(InputError):
        tautline.explore("open:5x5", base=(9, 9))
