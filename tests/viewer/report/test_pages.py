#!/usr/bin/env python3
"""Tests of the page of runs, without a browser: its contents, and that no text of a run becomes markup."""
import base64
import hashlib
import http.client
import json
import math
import re
import threading
import unittest
from html.parser import HTMLParser
from http.server import ThreadingHTTPServer
from pathlib import Path
from types import SimpleNamespace

from made import report_of, run_at, sweep_of

from bendlab.results import registry
from bendlab.results.load import group
from runs import collected, expectations
from runs.axes import axes_of, label_of
from sweep import charts, chosen_runs, live, run_facts
from tables import looks
from web.html_parts import VIEWER, json_text

MARKUP = "<script>alert(1)</script>\"'</script><!--<img src=x onerror=alert(2)>&amp;\u2028"
CELLS, MODEL, SEED = "/mesh/cells", "/bending/model", "/initial/seed"


def sweep_over_seeds():
    """Two models × two sizes × three seeds. The mean strain is cells · (1 + seed), and doubled for none."""
    axes = {MODEL: ["none", "adaptive"], CELLS: [8, 16], SEED: [1, 2, 4]}
    runs = [run_at({MODEL: model, CELLS: cells, SEED: seed},
                   {"mean_strain": cells * (1 + seed) * (2 if model == "none" else 1)})
            for model in axes[MODEL] for cells in axes[CELLS] for seed in axes[SEED]]
    return sweep_of(runs, axes)


def charts_of(sweep):
    varied, _ = axes_of(sweep)
    return charts.axis_charts(sweep, varied, charts.numbers_of(sweep), "make it", "s1-")


class Axes(unittest.TestCase):
    def test_cells_are_on_a_log2_axis(self):
        varied, _ = axes_of(sweep_over_seeds())
        self.assertEqual([axis.scale for axis in varied][:2], ["band", "log2"])
        self.assertEqual([axis.is_seed for axis in varied], [False, False, True])

    def test_values_with_a_ratio_of_eight_have_a_logarithmic_axis_if_none_is_zero(self):
        scale = lambda values: axes_of(sweep_of([], {"/a": values}))[0][0].scale
        self.assertEqual([scale([1, 8]), scale([1, 7]), scale([0, 100]), scale([True, False]),
                          scale([1, 2, 4])],
                         ["log", "linear", "linear", "band", "log"])

    def test_the_text_of_an_object_has_only_the_settings_that_differ(self):
        axis = axes_of(sweep_of([], {"/bending": [{"model": "lod", "k": 0.5, "lod": {"radius": 1}},
                                                  {"model": "lod", "k": 0.5, "lod": {"radius": 2}}]}))[0][0]
        self.assertEqual(axis.texts, ["radius 1", "radius 2"])
        self.assertEqual(axis.models, ["lod", "lod"])

    def test_axes_with_the_same_last_part_have_longer_labels(self):
        varied, _ = axes_of(sweep_of([], {"/a/stiffness": [1, 2], "/b/stiffness": [1, 2]}))
        self.assertEqual([axis.label for axis in varied], ["a stiffness", "b stiffness"])

    def test_a_setting_of_another_model_is_not_in_a_label(self):
        sweep = sweep_of([], {MODEL: ["none", "k_ring"], "/bending/k_ring/rings": [2, 3]})
        varied, _ = axes_of(sweep)
        self.assertEqual(label_of(run_at({MODEL: "none"}), varied), "none")

    def test_runs_without_a_point_get_one_from_their_settings(self):
        runs = [run_at({MODEL: model, CELLS: cells, "/follows": f"{model}!", "/same": 1},
                       id=f"{model}{cells}")
                for model in ("lod", "none") for cells in (16, 8)]
        for run in runs:
            run.point = {}
        sweep = collected._of_runs("here", runs)
        self.assertEqual(sweep.axes, {MODEL: ["lod", "none"], CELLS: [8, 16]})
        self.assertEqual(runs[0].point, {MODEL: "lod", CELLS: 16})


class Charts(unittest.TestCase):
    def test_a_chart_has_medians_and_ranges_over_seeds(self):
        chart = charts_of(sweep_over_seeds())[0]
        self.assertEqual((chart["x"]["scale"], chart["x"]["name"]), ("log2", CELLS))
        none, adaptive = chart["series"]
        self.assertEqual(none["x"], [8, 16])
        self.assertEqual(none["y"]["mean_strain"], [8 * 3 * 2, 16 * 3 * 2])  # the middle seed is 2
        self.assertEqual(adaptive["low"]["mean_strain"], [8 * 2, 16 * 2])
        self.assertEqual(adaptive["high"]["mean_strain"], [8 * 5, 16 * 5])
        self.assertEqual([len(runs) for runs in adaptive["runs"]], [3, 3])

    def test_further_axes_are_held_and_not_pooled(self):
        axes = {MODEL: ["none", "adaptive"], CELLS: [8, 16], "/damping": [0.1, 0.2, 0.4]}
        runs = [run_at({MODEL: m, CELLS: c, "/damping": d}, {"mean_strain": d}) for m in axes[MODEL]
                for c in axes[CELLS] for d in axes["/damping"]]
        chart = charts_of(sweep_of(runs, axes))[0]
        self.assertEqual([held["name"] for held in chart["held"]], ["/damping"])
        self.assertEqual(chart["held"][0]["at"], 1)
        at = {tuple(series["held"]): series["y"]["mean_strain"] for series in chart["series"]}
        self.assertEqual(at[(2,)], [0.4, 0.4])
        self.assertNotIn("low", chart["series"][0])

    def test_a_diverged_run_is_infinite_and_a_missing_run_has_no_point(self):
        axes = {CELLS: [8, 16, 32]}
        runs = [run_at({CELLS: 8}, {"mean_strain": 1}), run_at({CELLS: 16}, status="diverged"),
                run_at({CELLS: 32}, status="missing"), run_at({CELLS: 8, SEED: 2}, {"mean_strain": 2})]
        series = charts_of(sweep_of(runs, axes))[0]["series"][0]
        self.assertEqual((series["x"], series["y"]["mean_strain"]), ([8, 16], [1.5, "∞"]))

    def test_numbers_are_shortened_for_json(self):
        shortened = charts.shortened
        self.assertEqual([shortened(math.nan), shortened(math.inf), shortened(-math.inf),
                          shortened(1.23456789)],
                         [None, "∞", "-∞", 1.2346])

    def test_the_time_per_pass_is_for_a_sixtieth_of_a_second(self):
        run = run_at({CELLS: 8}, passes={"strain": 3.0, "bending": 1.0}, metrics={"time": [0.0, 0.5]})
        run.config["duration"] = 0.5
        chart = charts.pass_chart(sweep_of([run], {}), [], "", "p")
        self.assertEqual([part["label"] for part in chart["parts"]], ["strain", "bending"])
        self.assertEqual(chart["rows"][0]["values"], [100.0, 33.33])

    def test_a_bound_on_all_runs_is_a_line_in_the_chart(self):
        sweep = sweep_over_seeds()
        sweep.settings = {"expect": [{"metric": "mean_strain", "max": 7}, {"metric": "mean_strain", "min": 1,
                                                                           "where": {CELLS: 8}}]}
        self.assertEqual([limit["value"] for limit in charts_of(sweep)[0]["limits"]], [7])


class Expected(unittest.TestCase):
    def check(self, entry, run):
        return [expectation.holds for expectation in expectations.check({"expect": [entry]}, run)]

    def test_bounds_are_inclusive_and_nan_fails(self):
        at = lambda value: run_at({CELLS: 8}, {"m": value})
        bound = {"metric": "m", "min": 1, "max": 2}
        self.assertEqual([self.check(bound, at(v)) for v in (1, 2, 2.01, math.nan, math.inf)],
                         [[True], [True], [False], [False], [False]])
        self.assertEqual(self.check({"metric": "other", "max": 1}, at(1)), [False])

    def test_an_expectation_is_checked_only_where_it_applies(self):
        run = run_at({CELLS: 8, MODEL: "lod"}, {"m": 1})
        about = lambda where: len(self.check({"metric": "m", "max": 1, "where": where}, run))
        self.assertEqual([about({CELLS: 8.0}), about({CELLS: 16}), about({"/bending": {"model": "lod"}}),
                          about({"/not/there": 1}), about({"/not/there": None}),
                          about({"/defaults": "recommended"})],
                         [1, 0, 1, 0, 1, 1])

    def test_the_worst_metric_is_nearest_to_its_limit(self):
        sweep = sweep_of([], {}, {"expect": [{"metric": "a", "max": 10, "why": "far"},
                                             {"metric": "b", "min": 1, "max": 3, "why": "near"}]})
        worst = run_facts.worst(run_at({}, {"a": 1.0, "b": 2.9}), sweep)
        self.assertEqual((worst["label"], worst["limit"], worst["held"], worst["note"]),
                         ("b", 3.0, True, "near"))
        self.assertFalse(run_facts.worst(run_at({}, {"a": 11.0, "b": 2.9}), sweep)["held"])


class Chosen(unittest.TestCase):
    def runs(self, count, status=lambda i: "complete"):
        axes = {MODEL: ["none", "adaptive"], CELLS: list(range(1, count // 2 + 1))}
        places = [(m, c) for m in axes[MODEL] for c in axes[CELLS]]
        runs = [run_at({MODEL: m, CELLS: c}, status=status(i), file=Path(f"/r/cells={c}/run.vtkhdf"),
                       metrics={"time": [0.0, 1.0]}) for i, (m, c) in enumerate(places)]
        return sweep_of(runs, axes)

    def choose(self, sweep, **how):
        return chosen_runs.choose([sweep], [axes_of(sweep)[0]], **how)

    def test_few_runs_are_all_played(self):
        runs, why = self.choose(self.runs(8))
        self.assertEqual((len(runs), why), (8, ""))

    def test_many_runs_are_played_with_every_model_at_middle_values(self):
        runs, why = self.choose(self.runs(20))
        self.assertEqual([run.point for run in runs],
                         [{MODEL: "none", CELLS: 6}, {MODEL: "adaptive", CELLS: 6}])
        self.assertIn("every model, at cells 6", why)

    def test_a_failed_run_is_played_as_well(self):
        runs, why = self.choose(self.runs(20, lambda i: "diverged" if i == 3 else "complete"))
        self.assertEqual(runs[-1].status, "diverged")
        self.assertIn("diverged", why)

    def test_at_most_eight_of_many_values_are_played(self):
        axes = {CELLS: list(range(1, 101))}
        sweep = sweep_of([run_at({CELLS: c}, file=Path("f"), metrics={"time": [0.0]}) for c in axes[CELLS]],
                         axes)
        runs, _ = self.choose(sweep)
        self.assertEqual([runs[0].point[CELLS], runs[-1].point[CELLS], len(runs)], [1, 100, 8])

    def test_runs_can_be_chosen_by_name(self):
        self.assertEqual([run.id for run in self.choose(self.runs(20), wanted=["none-3", "cells=7"])[0]],
                         ["none-3", "none-7", "adaptive-7"])
        with self.assertRaisesRegex(ValueError, "no run with frames.*none-1"):
            self.choose(self.runs(20), wanted=["other"])


class Parsed(HTMLParser):
    """The tags of a page with their attributes, and the texts of its scripts and style sheets."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.scripts, self.inside = [], [], None
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.tags.append((tag, dict(attributes)))
        if tag in ("script", "style"):
            self.inside = (tag, dict(attributes), [])

    def handle_endtag(self, tag):
        if self.inside and tag == self.inside[0]:
            self.scripts.append((self.inside[0], self.inside[1], "".join(self.inside[2])))
            self.inside = None

    def handle_data(self, data):
        if self.inside:
            self.inside[2].append(data)


class Page(unittest.TestCase):
    def hostile(self):
        """A page in which every text of the runs is markup."""
        axes = {MODEL: ["none", MARKUP], f"/{MARKUP}/cells": [8, 16], "/text": [MARKUP, "b"]}
        runs = [run_at({MODEL: m, f"/{MARKUP}/cells": c, "/text": t}, {"mean_strain": c, MARKUP: c * 2.0},
                       status=status, id=f"{MARKUP}{c}{i}", name=MARKUP, passes={MARKUP: 1.0}, step_cpu_s=1.0,
                       metrics={"time": [0.0, 1.0]}, provenance={
                           "warnings": json.dumps([{"code": MARKUP, "message": MARKUP}]), "host": MARKUP,
                           "processor": MARKUP, "git_commit": MARKUP, "problem": MARKUP, "message": MARKUP,
                           "implausible": json.dumps({"bound": MARKUP, "measured": 2, "limit": 1,
                                                      "unit": MARKUP,
                                                      "time": 1, "vertex": 3, "advice": MARKUP,
                                                      "constraint": {"kind": MARKUP, "correction": 1}})})
                for i, (m, t) in enumerate([(m, t) for m in axes[MODEL] for t in axes["/text"]])
                for c, status in ((8, "implausible"), (16, "diverged"))]
        settings = {"description": MARKUP, "expect": [{"metric": "mean_strain", "max": 9, "why": MARKUP,
                                                       "where": {MODEL: MARKUP}}]}
        sweep = sweep_of(runs, axes, settings, config=f"/{MARKUP}.json", overrides=[f"/a={MARKUP}"],
                         notes=[MARKUP])
        sweep.name = MARKUP
        return report_of(sweep, command=f"./bendlab report '{MARKUP}'")

    def test_no_text_of_a_run_becomes_markup(self):
        text = self.hostile().html()
        parsed = Parsed(text)
        self.assertEqual([attributes.get("type") for tag, attributes in parsed.tags if tag == "script"],
                         ["application/json", None])
        self.assertNotIn("img", [tag for tag, _ in parsed.tags])
        for tag, attributes in parsed.tags:
            self.assertFalse([name for name in attributes if name.startswith("on") or name == "style"], tag)
        data = json.loads(next(body for tag, attributes, body in parsed.scripts if attributes.get("type")))
        self.assertEqual(data["runs"][0]["name"], MARKUP)

    def test_the_policy_has_the_hashes_of_the_script_and_of_the_style_sheet(self):
        parsed = Parsed(self.hostile().html())
        policy = next(a["content"] for tag, a in parsed.tags
                      if a.get("http-equiv") == "Content-Security-Policy")
        rules = dict(rule.strip().split(" ", 1) for rule in policy.split(";"))
        self.assertEqual((rules["default-src"], rules["connect-src"], rules["base-uri"]), ("'none'",) * 3)
        for tag, rule in (("script", "script-src"), ("style", "style-src")):
            body = next(body for name, attributes, body in parsed.scripts if name == tag
                        and "type" not in attributes)
            digest = base64.b64encode(hashlib.sha256(body.encode()).digest()).decode()
            self.assertEqual(rules[rule], f"'sha256-{digest}'")
        self.assertNotIn("unsafe", policy)

    def test_json_cannot_end_a_script_element(self):
        text = json_text({"a": MARKUP})
        self.assertFalse(set("<>&\u2028") & set(text))
        self.assertEqual(json.loads(text), {"a": MARKUP})

    def test_ids_are_unique_and_links_have_a_target(self):
        text = report_of(sweep_over_seeds()).html()
        names = [attributes["id"] for _, attributes in Parsed(text).tags if "id" in attributes]
        self.assertEqual(sorted(set(names)), sorted(names))
        for tag, attributes in Parsed(text).tags:
            address = attributes.get("href", "#main") if tag == "a" else "#main"
            if not address.startswith("#run-"):
                self.assertIn(address[1:], names)

    def test_the_text_of_a_warning_ends_with_a_full_stop(self):
        for message in ("1 iteration does not converge", "1 iteration does not converge."):
            warnings = json.dumps([{"code": "unconverged", "message": message}])
            run = run_at({CELLS: 8}, {"mean_strain": 1.0}, provenance={"warnings": warnings})
            text = report_of(sweep_of([run], {CELLS: [8]})).html()
            self.assertIn("1 iteration does not converge.</p>", text)

    def test_a_live_page_has_no_text_that_becomes_wrong(self):
        for status in ("running", "complete"):
            report = report_of(sweep_of([run_at({CELLS: 8}, {}, status=status)], {CELLS: [8]}))
            top, _, _ = report.html(live={"every": 1, "frames": 1}).partition("<p id='live'")
            self.assertIn("The page follows this run while it is computed.", top)
            self.assertNotIn("class='tally'", top)

    def test_the_settings_of_a_run_are_common_settings_and_changes(self):
        runs = [run_at({CELLS: cells, "/x": [1, {"y": cells}]}, id=str(cells)) for cells in (8, 16, 16)]
        runs[2].id, runs[2].config = "other", {"mesh": {"cells": 99}}
        settings = run_facts.Settings(runs)
        for run in runs:
            whole = {pointer: value for pointer, value in settings.base.items()}
            for pointer, value in settings.changes(run).items():
                if value is None:
                    del whole[pointer]
                else:
                    whole[pointer] = value[0]
            self.assertEqual(whole, collected.flattened(run.config))

    def test_the_command_of_a_run_quotes_its_arguments(self):
        sweep = sweep_of([], {MODEL: ["none", "lod"], CELLS: [8, 16]}, {"name": "x"}, config="/far/it's.json",
                         overrides=["/a=1 2", f"{CELLS}=[8,16]"])
        command = run_facts.command(run_at({MODEL: "lod", CELLS: 8}), sweep)
        self.assertEqual(command,
                         "./bendlab run '/far/it'\"'\"'s.json' --set '/a=1 2' --set '/bending/model=lod' "
                         "--set '/mesh/cells=8'")


class Colours(unittest.TestCase):
    """Contrast of the colours in the style sheet, by WCAG 2.2."""

    def schemes(self):
        text = (VIEWER.parent / "src/page/page.css").read_text(encoding="utf-8")
        blocks = re.findall(r":root \{(.*?)\}", text, re.DOTALL)
        light, dark, printed = (dict(re.findall(r"--([\w-]+): (#[0-9a-f]{3,6})", block)) for block in blocks)
        return {"light": light, "dark": light | dark, "print": light | printed}

    def test_the_contrast_of_text_meets_level_aa(self):
        pairs = [(text, ground) for text in ("ink", "grey", "accent", "yes", "no", "open", "diverged")
                 for ground in ("paper", "soft")]
        pairs += [("ink", "holds"), ("ink", "fails"), ("ink", "open-soft")]
        pairs += [(f"step-{i}-ink", f"step-{i}") for i in range(1, 5)]
        for name, colours in self.schemes().items():
            for text, ground in pairs:
                with self.subTest(scheme=name, text=text, ground=ground):
                    self.assertGreaterEqual(looks.contrast(colours[text], colours[ground]), 4.5)

    def test_lines_and_marks_have_enough_contrast(self):
        for name, ground in looks.GROUNDS.items():
            self.assertEqual(ground, {"light": "#ffffff", "dark": self.schemes()["dark"]["paper"]}[name])
            for look in [*map(looks.of_model, registry.models()), *map(looks.of_place, range(21))]:
                self.assertGreaterEqual(looks.contrast(look[name], ground), 3)

    def test_contrast_is_computed_as_in_the_standard(self):
        self.assertAlmostEqual(looks.contrast("#000", "#fff"), 21)
        self.assertAlmostEqual(looks.contrast("#777777", "#ffffff"), 4.48, places=2)  # WebAIM's example

    def test_no_two_series_look_alike(self):
        different = {json.dumps(looks.of_place(i), sort_keys=True) for i in range(21)}
        self.assertEqual(len(different), 21)
        families = {name: {(look["mark"], look.get("hollow", False)) for look in map(looks.of_model, models)}
                    for name, models in group(registry.models(), looks.family).items()}
        self.assertEqual(families["springs"], {("o", False)})
        self.assertTrue(all(hollow for _, hollow in families["hinges"]))


class Served(unittest.TestCase):
    """Answers of the server of a live page."""

    def setUp(self):
        news = {"frames": 3, "status": "running"}
        report = SimpleNamespace(live_page="<page>", news=news)
        handler = live.handler_of(SimpleNamespace(report=lambda: report), "secret")
        self.server = ThreadingHTTPServer(("127.0.0.1", 0), handler)
        self.port = self.server.server_port
        threading.Thread(target=self.server.serve_forever, daemon=True).start()

    def tearDown(self):
        self.server.shutdown()
        self.server.server_close()

    def ask(self, path, host=None, method="GET"):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=5)
        connection.request(method, path, headers={"Host": host or f"127.0.0.1:{self.port}"})
        try:
            answer = connection.getresponse()
            return answer.status, answer.read(), dict(answer.getheaders())
        finally:
            connection.close()

    def test_the_server_sends_the_page_and_its_frames(self):
        status, body, headers = self.ask("/secret/")
        self.assertEqual((status, body), (200, b"<page>"))
        self.assertEqual((headers["Referrer-Policy"], headers["Cache-Control"]), ("no-referrer", "no-store"))
        self.assertEqual(json.loads(self.ask("/secret/frames?have=2-running")[1])["frames"], 3)
        self.assertEqual(self.ask("/secret/frames?have=3-running")[0], 204)

    def test_the_server_sends_nothing_for_other_paths(self):
        for path in ("/", "/secret", "/secre/", "/secret/../", "/secret/x", "/secret//etc/passwd",
                     "/etc/passwd", "/%73ecret/", "/secret/frames/", "/secret/frames.html"):
            with self.subTest(path=path):
                self.assertEqual(self.ask(path)[0], 404)

    def test_the_server_refuses_other_hosts_and_methods(self):
        for host in ("evil.example", f"evil.example:{self.port}", "127.0.0.1",
                     f"127.0.0.1:{self.port}.evil.example"):
            with self.subTest(host=host):
                self.assertEqual(self.ask("/secret/", host)[0], 404)
        for method in ("POST", "PUT", "DELETE", "OPTIONS"):
            with self.subTest(method=method):
                self.assertEqual(self.ask("/secret/", method=method)[0], 405)


if __name__ == "__main__":
    unittest.main()
