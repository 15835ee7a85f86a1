"""The HTML that all pages share: the frame with style sheet and security policy, sections, tables."""
import base64
import hashlib
import html
import json
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

MANY, CHOICES = 12, 14  # most rows of a table without filters; most values in the filter of a column
LONG = 60  # letters of a cell; a longer text is broken into lines
MOST_TEXT = 420  # characters of a section's text that are not folded
VIEWER = Path(__file__).resolve().parents[1] / "viewer/dist"
PAGE = """<!doctype html>
<html lang="en"><head><meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,">
<title>{title}</title>
<style>{style}</style></head>
<body>
<a class='skip' href='#main'>Skip to the content</a>
{places}<header class='bar'><div>{home}<nav aria-label='Sections'>{links}</nav></div></header>
<main id='main'>
{top}
{sections}</main>
{made}
<script type='application/json' id='bendlab-data'>{data}</script>
{frames}
<script>{script}</script></body></html>
"""


@dataclass
class Part:
    """A section of a page with an address of its own."""

    name: str  # its address, as in #name
    title: str
    body: str  # HTML
    link: str = ""  # its name in the navigation; "": the title


@dataclass
class Made:
    """The origin of a page."""

    commit: str
    date: str
    machine: str
    command: str

    @property
    def html(self):
        texts = {"Made by": self.command, "Commit": self.commit, "Date": self.date, "Machine": self.machine}
        shown = {name: escape(text) for name, text in texts.items() if text}
        if self.command:
            shown["Made by"] = element("code", shown["Made by"])
        entries = "".join(f"<dt>{name}</dt><dd>{text}</dd>" for name, text in shown.items())
        return f"<footer class='foot'><div><dl>{entries}</dl></div></footer>"


def page(title, top, parts, made, data, frames="", places="", player=True):
    """A whole page as HTML: the part above the sections, the sections, and the origin.

    `data`: what the page's scripts read (viewer/README.md). `frames`: the script elements that hold frames.
    `places`: links to other pages. The browser runs only the viewer's script, because the page's policy names
    the hashes of this script and of the style sheet. Without `player` the script is an eighth as long.
    """
    script, style = _viewer("viewer.js" if player else "page.js"), _viewer("viewer.css")
    connect = "'self'" if data.get("live") else "'none'"
    policy = (f"default-src 'none'; script-src {_hash(script)}; style-src {_hash(style)}; connect-src "
              f"{connect}; img-src 'self' file: data: blob:; media-src blob:; base-uri 'none'; form-action "
              "'none'")
    links = "".join(f"<a href='#{part.name}'>{escape(part.link or part.title)}</a>" for part in parts)
    sections = "".join(f"<section aria-labelledby='{part.name}'>{heading(part.name, part.title)}\n{part.body}"
                       "</section>\n" for part in parts)
    home = "" if places else "<a class='home' href='#main'>bendlab</a>"
    return PAGE.format(policy=policy, title=escape(title), style=style, places=places, home=home, links=links,
                       top=top, sections=sections, made=made.html, data=json_text(data), frames=frames,
                       script=script)


def heading(name, title, level=2):
    """A heading with an address, and a link to this address."""
    anchor = f"<a class='anchor' href='#{name}' aria-label='Address of this section'>#</a>"
    return f"<h{level} id='{name}'>{escape(title)}{anchor}</h{level}>"


def json_text(data):
    """JSON for the inside of a script element: no text in the JSON can end the element."""
    text = json.dumps(data, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    return text.translate({ord(character): f"\\u{ord(character):04x}" for character in "<>&\u2028\u2029"})


def _hash(text):
    """The hash of a script or style sheet, as a page's policy names it."""
    return "'sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() + "'"


@lru_cache(maxsize=None)
def _viewer(name):
    """A file of the viewer's bundle. ValueError if a text in the file would end an HTML element early."""
    text = (VIEWER / name).read_text(encoding="utf-8")
    if "</script" in text.lower() or "</style" in text.lower() or "<!--" in text:
        raise ValueError(f"{VIEWER / name} has a text that would end its HTML element early")
    return text


def section_part(section, heading_text, everything, verdicts=(), charts=()):
    """A section as a Part: charts and pictures, verdicts (HTML), text, missing runs, tables, commands.

    `everything`: the command that repeats the page, after the commands that repeat the section's runs.
    `charts`: pairs of a chart's HTML element ("" if the element is elsewhere in the page) and the chart's
    file for print, or "".
    """
    first, rest = _beginning(section.text)
    parts = [f"<p>{escape(first)}</p>"] if first else []
    if section.missing:
        missing = "<br>".join(map(escape, section.missing))
        parts.append(f"<div class='missing'>Missing:<br>{missing}</div>")
    parts += [*(place for place, _ in charts), *(picture_html(*picture) for picture in section.pictures)]
    parts += verdicts
    prints = "".join(picture_html(file, "") for _, file in charts if file)
    if prints:
        parts.append(folded("As a picture, for print", prints))
    if rest:
        parts.append(folded("More on how it was measured", f"<p>{escape(rest)}</p>"))
    tables = [table_html(table) for table in section.tables if table.rows and table.caption]
    if tables:
        title = "All numbers" if len(tables) == 1 else f"All numbers, {len(tables)} tables"
        parts.append(folded(title, "".join(tables)))
    repeat = "\n".join([*section.commands, everything])
    parts.append(folded("Repeat it", f"<pre>{escape(repeat)}</pre>"))
    return Part(section.id, heading_text, "\n".join(parts), section.link)


def folded(title, body):
    """HTML that is hidden until the reader clicks on its title."""
    return f"<details><summary>{escape(title)}</summary>{body}</details>"


def picture_html(name, caption):
    """A picture with its caption."""
    return (f"<figure><img src='{escape(name)}' alt='{escape(caption)}' loading='lazy'><figcaption>"
            f"{escape(caption)}</figcaption></figure>")


def chart_html(chart, note="", titled=True, prefix=""):
    """The element in which the page's script draws a chart. `prefix`: the beginning of its address."""
    text = " ".join(filter(None, (chart.get("note", ""), note)))
    title = element("b", escape(chart["title"])) if titled else ""
    caption = title + (element("span", escape(text)) if text else "")
    return element("figure", element("figcaption", caption) if caption else "", class_="chart",
                   data_chart=chart["id"], id=prefix + chart["id"])


def _beginning(text):
    """(the first sentences of a long text, the rest)."""
    cut = text[:MOST_TEXT].rfind(". ") if len(text) > 1.5 * MOST_TEXT else 0
    return (text[:cut + 1], text[cut + 2:]) if cut > 0 else (text, "")


# --- tables ------------------------------------------------------------------------------------------------

def table_html(table, opens=""):
    """A table as HTML, which the reader can sort and filter. Columns of text are left-aligned. `opens`: a
    column of run ids, whose cells open the runs."""
    texts = table.texts()
    if not texts:
        return ""
    head, columns, many = "", [], len(texts) > MANY
    for column, shown in zip([column for column in table.columns if column.shown], zip(*texts)):
        values = [row.get(column.id) for row in table.rows]
        of_text = any(isinstance(value, str) for value in values)
        choose = of_text and many and 1 < len(set(shown)) <= CHOICES
        look = "t choose" if choose else "t" if of_text else ""
        head += element("th", escape(column.title), class_=look, title=column.meaning)
        columns.append([opener(id, escape(id[:8])) for id in shown] if column.id == opens else
                       [_cell(of_text, value, text) for value, text in zip(values, shown)])
    rows = "\n".join(row_html(cells) for cells in zip(*columns))
    return scroll_table(row_html(head), rows, table.caption if many else "", many, table.caption,
                        class_="sortable", data_rows="runs" if opens else "")


def _cell(of_text, value, text):
    """A cell. If the text of a number does not sort like the number, the cell also has the value (data-v)."""
    sorts_as = value[0] if isinstance(value, (list, tuple)) and value else value
    is_plain = of_text or not isinstance(sorts_as, (int, float)) or text == str(sorts_as)
    return element("td", escape(text), class_=("t text" if len(text) > LONG else "t") if of_text else "",
                   data_v="" if is_plain else f"{sorts_as:.9g}".replace("inf", "∞"))


def scroll_table(head, rows, label="", tall=False, caption="", **attributes):
    """A table of rows (HTML), which scrolls sideways if the screen is narrow, and also up and down if the
    table is `tall`. `label`: its name for readers who scroll with keys. `attributes`: see element()."""
    body = (element("caption", escape(caption)) if caption else "") + (element("thead", head) if head else "")
    region = {"tabindex": "0", "role": "region", "aria_label": label} if label or tall else {}
    return element("div", element("table", body + element("tbody", rows), **attributes),
                   class_="scroll tall" if tall else "scroll", **region)


def row_html(cells):
    return element("tr", "".join(cells))


def head_html(*names):
    """A row of headings of columns of text."""
    return row_html(element("th", escape(name), class_="t") for name in names)


def matrix_table(corner, columns, rows, label, look, tall=False):
    """A table with a heading for each row and column. `corner`: what the headings of rows are. `rows`:
    heading → cells, as HTML. `look`: its CSS classes."""
    titles = [element("th", escape(name), scope="col") for name in columns]
    head = row_html([element("th", corner, class_="t"), *titles])
    body = "".join(f"<tr><th scope='row' class='t'>{title}</th>{''.join(cells)}</tr>\n"
                   for title, cells in rows.items())
    return scroll_table(head, body, label, tall, class_=look)


def opener(ids, body, cell="t", look="opens", label="", **attributes):
    """A cell with a button that opens runs. `ids`: of the runs, with spaces between them. `cell` and `look`:
    CSS classes of the cell and the button. `label`: the name of the button, if the body does not tell it."""
    button = element("button", body, type="button", class_=look, aria_label=label)
    return element("td", button, class_=cell, data_run=ids, **attributes)


def element(name, body="", **attributes):
    """An HTML element. Attributes without a value are left out. class_ means class; data_v means data-v."""
    text = "".join(f" {key.rstrip('_').replace('_', '-')}='{escape(value)}'"
                   for key, value in attributes.items() if value)
    return f"<{name}{text}>{body}</{name}>"


def escape(text):
    return html.escape(str(text), quote=True)
