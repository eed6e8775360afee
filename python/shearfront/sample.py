# SPDX-License-Identifier: BSD-3-Clause
"""Samples of the posterior of a fit file, on the command line: what ``shearfront sample`` runs."""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ._errors import InputError, NoResult, one_complaint
from ._fit import read_fit

if TYPE_CHECKING:
    from collections.abc import Sequence


def _changes(words: list[str]) -> dict[str, float]:
    """Numbers by the entries of the scene that take them."""
    numbers: dict[str, float] = {}
    for word in words:
        key, _, text = word.partition("=")
        try:
            number = float(text)
        except ValueError:
            key = ""
        if not key:
            raise one_complaint("--set", word, "must be an entry and its number, such as shear_rate.values[1]=0.4")
        if key in numbers:
            raise one_complaint("--set", word, "must not change an entry twice")
        numbers[key] = number
    return numbers


def _columns(samples: Any, names: list[str]) -> tuple[list[str], list[list[str]]]:
    """Header, and one row for each draw, chains one after the other."""
    posterior = samples.posterior
    columns = []
    for name in names:
        field, _, rest = name.partition("[")
        values = posterior[field].values
        columns.append(values[:, :, int(rest[:-1])] if rest else values)
    if "sigma" in posterior:
        names, columns = [*names, "sigma"], [*columns, posterior["sigma"].values]
    chains, draws = columns[0].shape
    rows = [[str(c), str(d), *(repr(float(x[c, d])) for x in columns)] for c in range(chains) for d in range(draws)]
    return ["chain", "draw", *names], rows


def _summary(samples: Any, names: list[str]) -> str:
    import arviz

    table: Any = arviz.summary(samples, var_names=sorted({n.split("[")[0] for n in names}), round_to="none")
    lines = [f"{'unknown':24} {'mean':>12} {'sd':>10} {'2.5 %':>12} {'97.5 %':>12} {'R-hat':>7} {'bulk ESS':>9} {'tail ESS':>9}"]
    quantiles = samples.posterior.quantile([0.025, 0.975], dim=("chain", "draw"))
    for name in names:
        field, _, rest = name.partition("[")
        low, high = (float(q[int(rest[:-1])] if rest else q) for q in quantiles[field].values)
        row = table.loc[name if rest else field]
        numbers = f"{row['mean']:12.6g} {row['sd']:10.3g} {low:12.6g} {high:12.6g}"
        lines.append(f"{name:24} {numbers} {row['r_hat']:7.3f} {row['ess_bulk']:9.0f} {row['ess_tail']:9.0f}")
    return "\n".join(lines)


def _write(path: str, comments: list[str], header: list[str], rows: list[list[str]]) -> None:
    """The whole file or none."""
    target = Path(path)
    with tempfile.NamedTemporaryFile("w", dir=target.parent, delete=False, prefix=".sample-", suffix=".csv") as file:
        file.writelines(f"# {line}\n" for line in comments)
        file.write(",".join(header) + "\n")
        file.writelines(",".join(row) + "\n" for row in rows)
    os.replace(file.name, target)


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs ``shearfront sample FIT``; the exit code is that of the program.

    Parameters
    ----------
    arguments : sequence of str, optional
        Those of the command line unless given.

    Returns
    -------
    int
        0 done, 1 no usable result, 2 bad input.

    Examples
    --------
    >>> from shearfront.sample import main
    >>> main(["no-such-file.toml"])
    2
    """
    parser = argparse.ArgumentParser("shearfront sample", description="Samples of the posterior of a fit", allow_abbrev=False)
    parser.add_argument("fit", metavar="FIT", help="fit file; [prior] has what was known before")
    parser.add_argument(
        "--set",
        metavar="KEY=VALUE",
        action="append",
        default=[],
        help="another number for an entry of the scene; may be repeated",
    )
    parser.add_argument("-o", metavar="FILE", default="", help="all draws as CSV: chain, draw, unknowns")
    parser.add_argument("--draws", type=int, default=1000, help="of each chain, default 1000")
    parser.add_argument("--chains", type=int, default=4, help="default 4")
    parser.add_argument("--tune", type=int, default=400, help="draws before the first that counts, default 400")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--sampler", choices=["nutpie", "emcee"], default="nutpie", help="emcee needs no gradient: for points")
    asked = parser.parse_args(arguments)
    for option in ("draws", "chains", "tune"):
        if getattr(asked, option) < 1:
            print(f"--{option} = {getattr(asked, option)}; must be at least 1", file=sys.stderr)
            return 2
    if asked.o and not Path(asked.o).resolve().parent.is_dir():
        print(f"{asked.o}: cannot be written: No such file or directory", file=sys.stderr)
        return 2
    try:
        posterior = read_fit(asked.fit, _changes(asked.set)).posterior()
        samples = posterior.sample(asked.draws, asked.chains, asked.tune, seed=asked.seed, sampler=asked.sampler)
    except InputError as error:
        print(error, file=sys.stderr)
        return 2
    except NoResult as error:
        print(f"shearfront: no result: {error}", file=sys.stderr)
        return 1
    except ImportError as error:
        print(f"shearfront: no result: {error}; pip install 'shearfront[bayes]'", file=sys.stderr)
        return 1
    print(_summary(samples, posterior.names))
    if asked.o:
        priors = [f"prior of {name}: {prior}" for name, prior in posterior.priors.items()]
        made = f"{asked.sampler}, {asked.chains} chains of {asked.draws} draws after {asked.tune}, seed {asked.seed}"
        _write(asked.o, [f"samples of the posterior of {asked.fit}: {made}", *priors], *_columns(samples, posterior.names))
    return 0


if __name__ == "__main__":
    sys.exit(main())
