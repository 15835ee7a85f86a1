"""Tests of tables of raw rows, of their charts, files and HTML, and of sections, on invented rows."""
import json
import math
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path
from unittest import mock

import matplotlib.pyplot as plt
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "analysis"))
from bendlab.results import registry  # noqa: E402
from draw import chart_files  # noqa: E402
from tables import looks  # noqa: E402
from tables.chart import Chart, resolved  # noqa: E402
from tables.committed import COMMITTED  # noqa: E402
from tables.section import Check, Claim, Section, bits_of, write_objects  # noqa: E402
from tables.table import Column, Table, cell_text  # noqa: E402
from web.html_parts import CHOICES, MANY, table_html  # noqa: E402

INF, NAN = math.inf, math.nan


def error_table(models=("none", "dihedral"), meshes=("grid", "disc"), cells=(8, 16, 32)):
    """A table of errors 100 / cells, times 2 for the second model, times 10 for the second mesh."""
    rows = [{"model": model, "mesh": mesh, "cells": n, "runs": [f"{model}-{mesh}-{n}"],
             "error": 100 / n * (1 + models.index(model)) * 10**meshes.index(mesh), "ms": n * n / 64}
            for model in models for mesh in meshes for n in cells]
    return Table.of("errors", "Errors", [
        "model", "mesh", ("cells", "cells along the width"), ("error", "error", "", "%", "how far off"),
        ("ms", "time", ".2f", "ms")], rows)


def chart_of(table, *more, tables=(), **how):
    """The data of the chart of a table."""
    chart = Chart("a", "A title", table.id, *more, **how)
    return resolved(chart, {entry.id: entry for entry in (table, *tables)}, "make it")


def labels_of(chart):
    return [series["label"] for series in chart["series"]]


class CellText(unittest.TestCase):
    def test_whole_numbers_have_all_digits_and_other_numbers_have_three_digits(self):
        values = (0, 12345678, -7, 0.12345, 1234.5, 1.5e-7, np.float64(2))
        self.assertEqual([cell_text(value) for value in values],
                         ["0", "12345678", "-7", "0.123", "1234", "1.50e-07", "2.00"])

    def test_a_format_applies_to_all_numbers(self):
        self.assertEqual([cell_text(*cell) for cell in ((0.12345, ".1f"), (1234567, ",d"), (1234.5, ",.0f"),
                                                       (-3.14159, "+.2f"), (3.14159, "+.2f"))],
                         ["0.1", "1,234,567", "1,234", "-3.14", "+3.14"])

    def test_a_pair_is_written_as_a_range_and_equal_ends_as_one_number(self):
        self.assertEqual([cell_text((1, 2)), cell_text([0.5, 0.25], ".2f"), cell_text((3, 3)),
                          cell_text((1.001, 1.002), ".1f"), cell_text((NAN, 2))],
                         ["1 – 2", "0.50 – 0.25", "3", "1.0", "– – 2"])

    def test_a_value_that_is_not_finite_is_a_sign_in_every_format(self):
        for form in ("", ".2f", ",d"):
            self.assertEqual([cell_text(value, form) for value in (NAN, None, INF, -INF)],
                             ["–", "–", "∞", "−∞"])

    def test_texts_and_truth_values_are_words(self):
        self.assertEqual([cell_text("a <b>", ".2f"), cell_text(True), cell_text(False, ".2f")],
                         ["a <b>", "yes", "no"])

    def test_a_value_below_the_least_known_value_is_written_as_below(self):
        self.assertEqual([cell_text(0.4, "", 1.2), cell_text(1.2, "", 1.2), cell_text(3, "", 1.2),
                          cell_text(None, "", 1.2), cell_text(NAN, "", 1.2), cell_text("none", "", 1.2),
                          cell_text(INF, ".1f", 1.2)],
                         ["below 1.2", "1.20", "3", "–", "–", "none", "∞"])


class Tables(unittest.TestCase):
    def table(self):
        columns = ["model", ("error_share", "", ".1f", "%"), Column("error", least="gap"),
                   ("place", "", "", "", "", False)]
        return Table.of("t", "A caption", columns, [
            {"model": "none", "error_share": 12.34, "error": 0.1, "gap": 0.5, "place": 3},
            {"model": "lod", "error_share": NAN, "error": INF, "gap": 0.5}])

    def test_only_visible_columns_have_cells(self):
        self.assertEqual(self.table().texts(), [["none", "12.3", "below 0.50"], ["lod", "–", "∞"]])

    def test_a_title_has_its_unit_only_once(self):
        columns = [Column("drop", "drop", unit="m"), Column("share_of_all"), Column("x", unit="1"),
                   Column("t", "time (s)", unit="s"), Column("error_share", unit="%")]
        self.assertEqual([column.title for column in columns],
                         ["drop (m)", "share of all", "x", "time (s)", "error share (%)"])

    def test_only_texts_of_rows_need_no_column(self):
        table = Table.of("t", "", ["x"], [{"x": 1, "y": 2, "kind": "a"}, {"x": 2, "kind": "b"}])
        self.assertEqual(table.column("kind"), Column("kind"))
        for name in ("y", "absent"):
            with self.assertRaisesRegex(ValueError, f"the table t has no column {name}, but x"):
                table.column(name)

    def test_a_table_is_the_same_after_it_was_saved_as_json(self):
        table = self.table()
        kept = json.loads(json.dumps(table.as_json(), allow_nan=False))
        again = Table.of_json(kept)
        self.assertEqual((again.id, again.caption, again.columns), (table.id, table.caption, table.columns))
        self.assertEqual(again.rows[0], table.rows[0])
        self.assertEqual(again.rows[1], {"model": "lod", "error_share": None, "error": INF, "gap": 0.5})
        self.assertEqual(again.texts(), table.texts())
        self.assertEqual(again.as_json(), table.as_json())

    def test_infinite_ends_of_a_range_survive_json(self):
        rows = [{"a": (1.0, INF), "b": (-INF, NAN), "c": [1, 2]}]
        table = Table.of("t", "", ["a", "b", "c"], rows)
        again = Table.of_json(json.loads(json.dumps(table.as_json(), allow_nan=False)))
        self.assertEqual(again.texts(), table.texts())
        self.assertEqual(again.texts(), [["1.00 – ∞", "−∞ – –", "1 – 2"]])

    def test_a_row_has_a_value_for_each_column(self):
        for row in ((1,), (1, 2, 3)):
            with self.assertRaises(ValueError):
                Table.of("t", "", ["a", "b"], [row])

    def test_saved_numbers_have_nine_digits(self):
        kept = Table.of("t", "", ["a"], [{"a": 1 / 3}, {"a": 123456789012}]).as_json()["rows"]
        self.assertEqual(kept, [{"a": 0.333333333}, {"a": 123456789012}])


class Resolved(unittest.TestCase):
    def test_a_chart_has_a_curve_for_each_model(self):
        chart = chart_of(error_table(meshes=("grid",)), "cells", ["error", "ms"])
        self.assertEqual(labels_of(chart), ["none", "dihedral"])
        none, hinges = chart["series"]
        self.assertEqual((none["x"], none["y"]),
                         ([8, 16, 32], {"error": [12.5, 6.25, 3.125], "ms": [1, 4, 16]}))
        self.assertEqual(hinges["y"]["error"], [25, 12.5, 6.25])
        self.assertEqual(hinges["runs"], [[f"dihedral-grid-{cells}"] for cells in (8, 16, 32)])
        self.assertEqual(none["look"], looks.of_model("none"))
        self.assertEqual((chart["id"], chart["title"], chart["command"], chart["held"]),
                         ("a", "A title", "make it", []))
        self.assertEqual(chart["x"], {"name": "cells", "label": "cells along the width", "unit": "",
                                      "scale": "log"})
        self.assertEqual(chart["ys"][0], {"name": "error", "label": "error", "unit": "%",
                                          "meaning": "how far off"})

    def test_curves_by_several_columns_have_all_of_them_in_their_names(self):
        chart = chart_of(error_table(), "ms", ["error"], ["model", "cells"])
        self.assertEqual(labels_of(chart)[:2],
                         ["none, cells along the width 8", "none, cells along the width 16"])
        self.assertEqual(len(chart["series"]), 6)

    def test_points_are_sorted_by_x_and_points_without_x_are_left_out(self):
        rows = [{"model": "none", "x": x, "y": y} for x, y in (
            (4, 1.0), (1, 2.0), (None, 3.0), (2, None), (NAN, 4.0), (3, 5.0), (INF, 6.0))]
        series, = chart_of(Table.of("t", "", ["model", "x", "y"], rows), "x", ["y"])["series"]
        self.assertEqual((series["x"], series["y"]["y"]), ([1, 3, 4], [2, 5, 1]))

    def test_infinite_numbers_are_signs_and_unknown_numbers_are_none(self):
        values = (1.0, INF, -INF, NAN, 1.234567)
        rows = [{"model": "none", "x": i, "y": y, "z": 1} for i, y in enumerate(values)]
        series, = chart_of(Table.of("t", "", ["model", "x", "y", "z"], rows), "x", ["y", "z"])["series"]
        self.assertEqual(series["y"]["y"], [1, "∞", "-∞", None, 1.2346])

    def test_a_held_axis_has_an_initial_value(self):
        table = error_table(meshes=("grid", "disc", "tube"))
        for at, place in (("", 1), ("grid", 0), ("tube", 2)):
            chart = chart_of(table, "cells", ["error"], held=["mesh"], at=at)
            axis, = chart["held"]
            self.assertEqual((axis["name"], axis["label"], axis["values"], axis["at"]),
                             ("mesh", "mesh", ["grid", "disc", "tube"], place))
        errors = {(series["label"], *series["held"]): series["y"]["error"] for series in chart["series"]}
        self.assertEqual(len(errors), 6)
        self.assertEqual((errors["none", 0], errors["dihedral", 1]), ([12.5, 6.25, 3.125], [250, 125, 62.5]))

    def test_numbers_can_be_held_and_have_the_format_of_their_column(self):
        chart = chart_of(error_table(), "error", ["ms"], held=["cells", "mesh"])
        self.assertEqual([axis["values"] for axis in chart["held"]], [["8", "16", "32"], ["grid", "disc"]])
        self.assertEqual([axis["at"] for axis in chart["held"]], [1, 1])
        self.assertEqual(chart["held"][0]["label"], "cells along the width")

    def test_categories_of_a_band_are_in_the_order_of_the_rows(self):
        chart = chart_of(error_table(cells=(8,)), "mesh", ["error"], scale="band")
        self.assertEqual(chart["x"]["categories"], ["grid", "disc"])
        self.assertEqual(chart["series"][1]["x"], [0, 1])
        self.assertEqual(chart["series"][1]["y"]["error"], [25, 250])
        self.assertNotIn("ticks", chart["x"])

    def test_a_log2_axis_has_a_tick_at_each_value(self):
        chart = chart_of(error_table(cells=(32, 8, 16)), "cells", ["error"], scale="log2")
        self.assertEqual((chart["x"]["ticks"], chart["x"]["scale"]), ([8, 16, 32], "log2"))
        self.assertNotIn("ticks", chart_of(error_table(), "cells", ["error"])["x"])

    def test_only_columns_with_low_and_high_have_ranges(self):
        table = error_table(models=("none",), meshes=("grid",))
        for row in table.rows:
            row |= {"error_low": row["error"] / 2, "error_high": row["error"] * 2}
        series, = chart_of(table, "cells", ["error", "ms"])["series"]
        self.assertEqual((series["low"], series["high"]),
                         ({"error": [6.25, 3.125, 1.5625]}, {"error": [25, 12.5, 6.25]}))
        series, = chart_of(table, "cells", ["ms"])["series"]
        self.assertNotIn("low", series)

    def test_theory_is_a_line_at_every_held_value(self):
        known = registry.models()
        theory = Table.of("theory", "", ["model", "cells", "error"],
                          [{"model": "exact", "cells": n, "error": 100 / n} for n in (32, 8)])
        chart = chart_of(error_table(), "cells", ["error"], held=["mesh"], theory="theory", tables=[theory])
        line = chart["series"][-1]
        self.assertEqual((line["label"], line["held"], line["line"], line["look"]),
                         ("exact", [], True, looks.line()))
        self.assertEqual((line["x"], line["y"]["error"]), ([8, 32], [12.5, 3.125]))
        self.assertEqual(chart["held"][0]["values"], ["grid", "disc"])
        self.assertEqual(registry.models(), known)  # a theory is not a model
        alone = chart_of(error_table(), "cells", ["error"], held=["mesh"])
        self.assertEqual(len(alone["series"]), len(chart["series"]) - 1)

    def test_a_table_without_numbers_has_no_chart(self):
        for value in (None, NAN):
            rows = [{"model": "none", "x": 1, "y": value, "z": value}, {"model": "lod", "x": 2}]
            self.assertIsNone(chart_of(Table.of("t", "", ["model", "x", "y", "z"], rows), "x", ["y", "z"]))
        self.assertIsNone(chart_of(Table.of("t", "", ["model", "x", "y"], []), "x", ["y"]))

    def test_a_name_that_does_not_exist_is_an_error(self):
        known = {"table": "errors", "x": "cells", "ys": ["error"]}
        for wrong in ({"theory": "absent"}, {"limits": [("absent", 1, "")]}, {"held": ["absent"]},
                      {"curve": ["absent"]}, {"x": "absent"}, {"ys": ["error", "absent"]}, {"ys": ["absent"]},
                      {"table": "absent"}):
            with self.subTest(wrong), self.assertRaisesRegex(ValueError, "absent"):
                resolved(Chart("a", "A title", **known | wrong), {"errors": error_table()}, "")

    def test_the_charts_of_the_committed_pages_begin_with_a_value_that_exists(self):
        # A value without rows is no error, because rows may be missing on a user's page.
        began = 0
        for page in sorted(COMMITTED.glob("*/page.json")):
            for entry in json.loads(page.read_text(encoding="utf-8")):
                section = Section.of_json(entry)
                tables = {table.id: table for table in section.tables}
                for chart in (chart for chart in section.charts if chart.at):
                    data = resolved(chart, tables, "")
                    self.assertEqual(data["held"][0]["values"][data["held"][0]["at"]], chart.at, chart.id)
                    began += 1
        self.assertGreater(began, 4)

    def test_curves_of_the_same_model_have_different_lines(self):
        chart = chart_of(error_table(cells=(8, 16)), "ms", ["error"], ["model", "mesh"])
        self.assertEqual(labels_of(chart), ["none, grid", "none, disc", "dihedral, grid", "dihedral, disc"])
        first, second, third, fourth = (series["look"] for series in chart["series"])
        self.assertEqual([first, third], [looks.of_model("none"), looks.of_model("dihedral")])
        for own, variant in ((first, second), (third, fourth)):
            self.assertEqual((variant["light"], variant["mark"]), (own["light"], own["mark"]))
            self.assertNotEqual(bool(variant.get("hollow")), bool(own.get("hollow")))
            self.assertNotEqual(variant["dash"], own.get("dash"))
        self.assertEqual(len({json.dumps(series["look"]) for series in chart["series"]}), 4)

    def test_looks_by_order_and_by_method_and_dashes_by_a_column(self):
        looks_of = lambda *more, **how: [series["look"] for series in chart_of(*more, **how)["series"]]
        places = looks_of(error_table(), "ms", ["error"], ["mesh"], look="")
        self.assertEqual(places, [looks.of_place(0), looks.of_place(1)])
        dashed = looks_of(error_table(), "ms", ["error"], ["model", "mesh"], look="", dashed="mesh")
        self.assertEqual([look.get("dash") for look in dashed], [None, looks.VARIANTS[1]] * 2)
        rows = [{"method": method, "x": 1, "y": 1.0} for method in ("pbd", "newton, euler")]
        table = Table.of("t", "", ["method", "x", "y"], rows)
        self.assertEqual(looks_of(table, "x", ["y"], ["method"], look="method"),
                         [looks.of_method("pbd"), looks.of_method("newton, euler")])

    def test_limits_scales_legends_and_notes_are_passed_on(self):
        chart = chart_of(error_table(), "cells", ["error"], y_scale="log", limits=[("error", 1, "enough")],
                         joined=False, legend=False, note="a note")
        self.assertEqual(chart["limits"], [{"metric": "error", "value": 1, "text": "enough"}])
        self.assertEqual((chart["y_scale"], chart["joined"], chart["legend"], chart["note"]),
                         ("log", False, False, "a note"))
        self.assertNotIn("legend", chart_of(error_table(), "cells", ["error"]))

    def test_bars_have_a_part_for_each_column(self):
        chart = self.bars()
        self.assertEqual((chart["kind"], [part["label"] for part in chart["parts"]]),
                         ("bars", ["error", "time"]))
        self.assertEqual([row["label"] for row in chart["rows"]], ["8", "16"])
        self.assertEqual([row["values"] for row in chart["rows"]], [[12.5, 1], [6.25, 4]])

    @staticmethod
    def bars():
        table = error_table(models=("none",), meshes=("grid",), cells=(8, 16))
        return chart_of(table, "cells", ["error", "ms"], kind="bars")


class Files(unittest.TestCase):
    def written(self, chart):
        """Writes the file of a chart, and returns its panels."""
        kept = []
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(chart_files.write_chart(chart, folder, "a"), "a.png")
            self.assertTrue((Path(folder) / "a.png").read_bytes().startswith(b"\x89PNG"))
        with mock.patch.object(chart_files.style, "save", lambda figure, *_, **__: kept.append(figure)):
            chart_files.write_chart(chart, "", "a")
        self.addCleanup(plt.close, kept[0])
        return [axes for axes in kept[0].axes if axes.axison]

    def test_every_held_value_has_a_panel(self):
        meshes = ("grid", "disc", "tube", "sphere", "strip")
        panels = self.written(chart_of(error_table(meshes=meshes), "cells", ["error", "ms"],
                                       held=["mesh"], scale="log2", limits=[("error", 1, "enough")]))
        self.assertEqual([axes.get_title(loc="left") for axes in panels], list(meshes))
        for place, axes in enumerate(panels):
            curves = {line.get_label(): line for line in axes.lines}
            np.testing.assert_allclose(curves["none"].get_ydata(), np.array([12.5, 6.25, 3.125]) * 10**place)
            np.testing.assert_array_equal(axes.get_xticks(), [8, 16, 32])

    def test_without_held_values_every_column_has_a_panel(self):
        panels = self.written(chart_of(error_table(meshes=("grid",)), "cells", ["error", "ms"]))
        self.assertEqual([axes.get_ylabel() for axes in panels], ["error (%)", "time (ms)"])

    def test_the_categories_of_a_band_are_along_y(self):
        table = error_table(cells=(8,))
        for row in table.rows:
            row |= {"error_low": row["error"] / 2, "error_high": row["error"] * 2}
        axes, = self.written(chart_of(table, "mesh", ["error"], scale="band", y_scale="log"))
        self.assertEqual([text.get_text() for text in axes.get_yticklabels()], ["grid", "disc"])
        np.testing.assert_array_equal(axes.lines[0].get_xdata(), [12.5, 125])
        np.testing.assert_array_equal(axes.lines[0].get_ydata(), [0, 1])
        bars = [[tuple(end) for end in bar] for bar in axes.collections[0].get_segments()]
        self.assertEqual(bars, [[(6.25, 0), (25, 0)], [(62.5, 1), (250, 1)]])
        self.assertEqual((axes.get_xscale(), axes.get_xlabel()), ("log", "error (%)"))

    def test_a_panel_of_a_held_band_has_only_its_own_categories(self):
        rows = [{"kind": kind, "name": name, "y": y} for kind, name, y in (
            ("models", "none", 1.0), ("models", "lod", 2.0), ("meshes", "grid", 3.0))]
        table = Table.of("t", "", ["kind", "name", "y"], rows)
        panels = self.written(chart_of(table, "name", ["y"], ["kind"], held=["kind"], scale="band", look=""))
        self.assertEqual([[text.get_text() for text in axes.get_yticklabels()] for axes in panels],
                         [["none", "lod"], ["grid"]])

    def test_bars_are_stacked(self):
        axes, = self.written(Resolved.bars())
        self.assertEqual([(bar.get_x(), bar.get_width()) for bar in axes.patches],
                         [(0, 12.5), (0, 6.25), (12.5, 1), (6.25, 4)])

    def test_every_metric_has_a_panel_and_held_values_without_a_panel_are_counted(self):
        metrics = ["error", "ms", "third", "fourth"]
        table = Table.of("t", "", ["model", "x", *metrics], [("none", 1, 1.0, 2.0, 3.0, 4.0)])
        self.assertEqual(len(self.written(chart_of(table, "x", metrics))), 4)
        meshes = [f"mesh {place}" for place in range(chart_files.MOST_PANELS + 2)]
        panels = self.written(chart_of(error_table(meshes=meshes), "cells", ["error"], held=["mesh"]))
        self.assertEqual(len(panels), chart_files.MOST_PANELS)
        self.assertIn("2 more values of mesh", panels[0].figure._suptitle.get_text())

    def test_an_infinite_bar_is_named(self):
        table = Table.of("t", "", ["model", "x", "y"], [("none", 1, INF), ("lod", 2, 3.0)])
        axes, = self.written(chart_of(table, "x", ["y"], kind="bars"))
        self.assertEqual([text.get_text() for text in axes.get_yticklabels()], ["1, ∞", "2"])
        self.assertEqual([bar.get_width() for bar in axes.patches], [0, 3])

    def test_a_chart_without_a_finite_number_has_no_file(self):
        table = Table.of("t", "", ["model", "x", "y"], [{"model": "none", "x": 1, "y": INF}])
        with tempfile.TemporaryDirectory() as folder:
            self.assertIsNone(chart_files.write_chart(chart_of(table, "x", ["y"]), folder, "a"))
            self.assertEqual(list(Path(folder).iterdir()), [])


class Cells(HTMLParser):
    """The tags of a text in their order: [name, attributes, inner text, also of inner tags]."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.opened = [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.tags.append([tag, dict(attributes), ""])
        self.opened.append(self.tags[-1])

    def handle_endtag(self, tag):
        assert self.opened.pop()[0] == tag, "a tag is not closed"

    def handle_data(self, data):
        for entry in self.opened:
            entry[2] += data

    def of(self, tag):
        return [(attributes, text) for name, attributes, text in self.tags if name == tag]


class Html(unittest.TestCase):
    MARKUP = "<i a='b'>\"'</td><script>alert(1)</script>&amp;"

    def test_cells_have_the_texts_of_the_table_and_raw_numbers_for_sorting(self):
        columns = ["model", ("a", "A", ".1f", "m", "what it is"), "n", "range", "known",
                   Column("hidden", shown=False)]
        table = Table.of("t", "A caption", columns, [
            {"model": "none", "a": 1.26, "n": 12, "range": (0.25, 4), "known": True, "hidden": "secret"},
            {"model": "lod", "a": INF, "n": 3, "range": (2, 2), "known": False},
            {"model": "k_ring", "a": None}])
        cells = Cells(table_html(table))
        self.assertEqual([text for _, text in cells.of("caption")], ["A caption"])
        self.assertEqual([text for _, text in cells.of("th")], ["model", "A (m)", "n", "range", "known"])
        self.assertEqual(cells.of("th")[1][0], {"title": "what it is"})
        texts = [text for _, text in cells.of("td")]
        self.assertEqual(texts, ["none", "1.3", "12", "0.250 – 4", "yes", "lod", "∞", "3", "2", "no",
                                 "k_ring", "–", "–", "–", "–"])
        self.assertEqual([attributes.get("data-v") for attributes, _ in cells.of("td")][:10],
                         [None, "1.26", None, "0.25", "1", None, "∞", None, None, "0"])
        self.assertEqual([attributes.get("class") for attributes, _ in cells.of("td")][:2], ["t", None])

    def test_cells_keep_nine_digits_in_an_attribute(self):
        rows = [{"x": 1 / 3, "least": 0.5}, {"x": 123456.789, "least": 0.5}, {"x": 1e-12, "least": 0.5}]
        table = Table.of("t", "", [Column("x", least="least")], rows)
        cells = Cells(table_html(table)).of("td")
        self.assertEqual([(text, attributes["data-v"]) for attributes, text in cells],
                         [("below 0.50", "0.333333333"), ("1.23e+05", "123456.789"),
                          ("below 0.50", "1e-12")])

    def test_a_long_table_has_all_its_rows_and_filters(self):
        self.assertLess(MANY, CHOICES)
        table = Table.of("t", "Long", ["kind", "name", "x"], [
            {"kind": "odd" if i % 2 else "even", "name": f"run {i}", "x": i} for i in range(CHOICES + 1)])
        cells = Cells(table_html(table))
        self.assertEqual([text for _, text in cells.of("td")],
                         [text for line in table.texts() for text in line])
        self.assertEqual([attributes.get("class") for attributes, _ in cells.of("th")],
                         ["t choose", "t", None])  # too many names to choose from
        self.assertEqual(cells.of("div")[0][0], {"class": "scroll tall", "tabindex": "0", "role": "region",
                                                "aria-label": "Long"})
        short = Cells(table_html(Table.of("t", "", ["kind"], table.rows[:MANY])))
        self.assertEqual([short.of(tag)[0][0]["class"] for tag in ("div", "th")], ["scroll", "t"])

    def test_markup_in_texts_is_escaped(self):
        columns = [(self.MARKUP,), "text", ("x", self.MARKUP, "", self.MARKUP, self.MARKUP)]
        row = {self.MARKUP: self.MARKUP, "text": self.MARKUP, "x": 1.5}
        table = Table.of("t", self.MARKUP, columns, [row] * (MANY + 1))
        cells = Cells(table_html(table, opens=self.MARKUP))
        self.assertEqual({tag for tag, *_ in cells.tags},
                         {"div", "table", "caption", "thead", "tbody", "tr", "th", "td", "button"})
        self.assertEqual(cells.of("caption")[0][1], self.MARKUP)
        self.assertEqual(cells.of("th")[2][0]["title"], self.MARKUP)
        self.assertEqual(cells.of("td")[1][1], self.MARKUP)
        self.assertEqual(cells.of("td")[0][0]["data-run"], self.MARKUP)
        ours = {"class", "title", "tabindex", "role", "aria-label", "type", "data-rows", "data-run", "data-v"}
        self.assertLessEqual({name for _, attributes, _ in cells.tags for name in attributes}, ours)

    def test_a_column_of_ids_opens_the_runs(self):
        table = Table.of("t", "", ["run", "x"], [{"run": "0123456789abcdef", "x": 1}])
        cells = Cells(table_html(table, "run"))
        self.assertEqual(cells.of("table")[0][0]["data-rows"], "runs")
        self.assertEqual(cells.of("td")[0], ({"class": "t", "data-run": "0123456789abcdef"}, "01234567"))
        self.assertEqual(len(cells.of("button")), 1)

    def test_a_table_without_rows_has_no_html(self):
        self.assertEqual(table_html(Table.of("t", "A caption", ["a"], [])), "")


class Sections(unittest.TestCase):
    def check(self, measured, kind="relative", expected=2.0):
        return Check("a length", "none", "grid", expected, measured, 0.25, "theory", kind)

    def test_a_check_holds_within_its_tolerance(self):
        judged = lambda *values, **how: [self.check(value, **how).holds for value in values]
        self.assertEqual(judged(1.5, 2.5, 1.4, 2.6, NAN, INF), [True, True, False, False, None, False])
        self.assertEqual(judged(1.75, 2.25, 1.7, kind="absolute"), [True, True, False])
        self.assertEqual(judged(-9, 2, 2.1, kind="most"), [True, True, False])
        self.assertEqual([self.check(1, kind).bound for kind in ("relative", "absolute", "most")],
                         ["± 25 %", "± 0.25", "at most"])

    def test_claims_and_checks_are_rounded_and_written_as_json(self):
        claim = Claim("5", "it holds", "a rule", {"a": 1.23456, "b": [INF, NAN, 2]}, None, setting="here")
        self.assertEqual(claim.as_json(), {"figure": "5", "claim": "it holds", "rule": "a rule", "note": "",
                                           "numbers": {"a": 1.235, "b": ["inf", None, 2]}, "holds": None,
                                           "setting": "here"})
        self.assertNotIn("setting", Claim("5", "", "", {}, True).as_json())
        objects = [claim.as_json(), self.check(NAN).as_json()]
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "summary.json"
            write_objects(file, objects)
            text = file.read_text(encoding="utf-8")
        self.assertEqual(json.loads(text), objects)
        self.assertEqual(len(text.splitlines()), 4)  # a line per object, and the brackets

    def test_a_section_keeps_only_values_that_columns_and_charts_show(self):
        table = error_table(models=("none",), meshes=("grid",), cells=(8,))
        table.columns.append(Column("least", least="gap"))
        table.rows[0] |= {"unused": 1, "gap": 2, "error_low": 3, "kind": "a", "other_low": 4}
        chart = Chart("a", "", "errors", "cells", ["error"], held=["kind"])
        row, = Section("a", "A", charts=[chart], tables=[table]).as_json()["tables"][0]["rows"]
        self.assertEqual(set(row), {"model", "mesh", "cells", "error", "ms", "runs", "gap", "error_low",
                                    "kind"})

    def test_a_section_returns_the_rows_of_a_table_by_id(self):
        section = Section("a", "A", tables=[Table.of("t", "", ["x"], [{"x": 1}])])
        self.assertEqual((section.table("t"), section.table("other")), ([{"x": 1}], []))

    def test_a_section_records_commands_missing_runs_and_bits_of_its_experiments(self):
        origin = {"git_commit": "0123456789abcdef", "git_dirty": "yes", "host": "h"}
        run = mock.Mock(point={"/mesh/cells": 8}, summary={"drop": 0.5}, over=True, file=None,
                        provenance=origin)
        unfinished = mock.Mock(point={"/mesh/cells": 16}, over=False)
        experiment = mock.Mock(command="./bendlab run a", config="b/a", runs=[unfinished, run],
                               missing_text="1 run")
        section = Section("a", "A")
        self.assertEqual(section.uses(experiment), [unfinished, run])
        self.assertEqual(section.commands, ["./bendlab run a"])
        self.assertEqual(section.missing, ["configs/b/a.json: 1 run"])
        self.assertEqual([*section.bits["b/a"].values()], [bits_of(run)])  # an unfinished run has no bits
        self.assertEqual(section.origins, [{"commit": "0123456789ab with changes", "machine": "", "host": "h",
                                            "date": ""}])


if __name__ == "__main__":
    unittest.main()
