"""How results are printed."""


def seconds(value, extrapolated=False):
    digits = 3 if value < 1 else 2 if value < 10 else 1 if value < 100 else 0
    return ("~" if extrapolated else "") + f"{value:.{digits}f}"


def rate(value):
    return f"{value:.1f}" if value < 100 else f"{value:,.0f}"


class Table:
    """Prints rows as they come; columns are (title, width), the first one left-aligned."""

    def __init__(self, *columns):
        self.columns = columns
        lines = [title.split("\n") for title, _ in columns]
        for line in range(max(map(len, lines))):
            self.row(*[title[line] if line < len(title) else "" for title in lines])
        print("-" * (sum(width for _, width in columns) + len(columns) - 1), flush=True)

    def row(self, *cells):
        first, *others = [str(cell) for cell in cells]
        padded = [first.ljust(self.columns[0][1])]
        padded += [cell.rjust(width) for cell, (_, width) in zip(others, self.columns[1:])]
        print(" ".join(padded).rstrip(), flush=True)
