"""Tables of the results of figures, for charts, pictures, pages and READMEs: rows with named columns.

A row is a dictionary of texts and of numbers that are not rounded. Only cell_text() writes a number as text.
"""
from dataclasses import asdict, dataclass

from tables.numbers import known, number, rounded

EXACT = 9  # significant digits of the numbers that a page keeps


@dataclass
class Column:
    id: str
    label: str = ""  # "": the id
    form: str = ""  # how numbers are written: a format such as .3f, "" for three significant digits
    unit: str = ""
    meaning: str = ""
    shown: bool = True  # whether tables show it; charts may use all columns
    least: str = ""  # a column with the smallest reliable number; smaller numbers are written as "below" it

    @property
    def name(self):
        return self.label or self.id.replace("_", " ")

    @property
    def title(self):
        """The name with its unit."""
        return self.name + (f" ({self.unit})" if self.unit not in ("", "1") and "(" not in self.name else "")

    def text(self, row):
        """The value of a row in this column, as text."""
        return cell_text(row.get(self.id), self.form, row.get(self.least))


@dataclass
class Table:
    id: str
    caption: str
    columns: list  # Column
    rows: list  # dictionaries: id of a column → number, text, or (low, high)

    @classmethod
    def of(cls, id, caption, columns, rows):
        """A table whose columns are given as ids or as tuples of the fields of Column. A row may also be a
        tuple of the values of all columns."""
        made = [column if isinstance(column, Column) else
                Column(column) if isinstance(column, str) else Column(*column) for column in columns]
        ids = [column.id for column in made]
        return cls(id, caption, made, [
            row if isinstance(row, dict) else dict(zip(ids, row, strict=True)) for row in rows])

    def column(self, id):
        """The column with this id. A text of the rows that tables do not show needs no declaration."""
        found = next((column for column in self.columns if column.id == id), None)
        if found is None and not all(isinstance(row.get(id), str) for row in self.rows):
            raise ValueError(f"the table {self.id} has no column {id}, but "
                             f"{', '.join(column.id for column in self.columns)}")
        return found or Column(id)

    def texts(self):
        """The cells of the columns that are shown, as texts."""
        return [[column.text(row) for column in self.columns if column.shown] for row in self.rows]

    def as_json(self, used=None):
        """The table as JSON. `used`: the names of the values of rows to keep; None keeps all values."""
        rows = [{name: value for name, value in row.items() if used is None or name in used}
                for row in self.rows]
        columns = [{name: value for name, value in asdict(column).items()
                    if value != getattr(Column, name, "")} for column in self.columns]
        return {"id": self.id, "caption": self.caption, "columns": columns, "rows": rounded(rows, EXACT)}

    @classmethod
    def of_json(cls, kept):
        """The table that as_json() wrote. NaN was written as None, and stays None."""
        rows = [{name: _read(value) for name, value in row.items()} for row in kept["rows"]]
        return cls(kept["id"], kept["caption"], [Column(**column) for column in kept["columns"]], rows)


def _read(value):
    """A value of a row that as_json() wrote."""
    if isinstance(value, list):
        return [_read(end) for end in value]
    return known(value) if value in ("inf", "-inf") else value


def cell_text(value, form="", least=None):
    """A value as text: integers without change, other numbers in the format `form`, a pair as a range. A
    number below `least` is written as "below" and this number."""
    if least is not None and isinstance(value, (int, float)) and value < least:
        return f"below {number(least, 2)}"
    if isinstance(value, (list, tuple)):
        ends = list(dict.fromkeys(cell_text(end, form) for end in value))
        return " – ".join(ends)
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, str):
        return value
    if value is None or value != value or abs(value) == float("inf"):
        return number(value)
    if form:
        return format(value, form)
    return str(value) if isinstance(value, int) else number(value)
