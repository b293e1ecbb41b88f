from importlib.metadata import distribution


def test_the_wheel_has_the_licences_and_puts_nothing_under_the_name_of_another_project():
    package = distribution("pytautline")
    names = {file.name for file in package.files}
    assert {"LICENSE-MIT", "LICENSE-APACHE"} <= names
    # A package and a command `tautline` are another project's.
    assert {file.parts[0].removesuffix(f"-{package.version}.dist-info") for file in package.files} == {"pytautline"}
    assert not package.entry_points
