#!/usr/bin/env python3
"""Writes tables of one drive into tables.json, in the forms in which people save tables with pandas.

    pip install pandas && python3 tables.py

The drive of tests/node/log-tables.test.js is a circle with a radius of 1.25 m at 0.5 rad/s, with 16 rows a second.
"""

import json
import math
import pathlib

import pandas as pd

SCRIPT_DIRECTORY = pathlib.Path(__file__).parent
START = 1_718_000_000

rows = []
for i in range(24):
    theta = i / 32 - 0.75
    rows.append({"t": i / 16, "x": 1.25 * math.sin(theta), "y": -1.25 * math.cos(theta), "yaw": theta})
drive = pd.DataFrame(rows)
dates = pd.to_datetime(START * 10**9 + (drive["t"] * 1e9).astype("int64"))

# Second log for a merged table, in which the rows of both logs alternate. In each row the cells of one log are empty.
other = drive.assign(t=drive["t"] + 0.03, x=drive["x"] + 4)
odometry = drive.set_index("t").add_prefix("odom_")

TABLES = {
    "index": drive.to_csv(),
    "utc": drive.assign(t=dates.dt.tz_localize("UTC")).to_csv(index=False),
    "berlin": drive.drop(columns="t").set_index(pd.DatetimeIndex(dates).tz_localize("UTC").tz_convert("Europe/Berlin")).to_csv(),
    "naive": drive.drop(columns="t").set_index(pd.DatetimeIndex(dates)).to_csv(),
    "timedelta": drive.assign(t=pd.to_timedelta(drive["t"], unit="s")).to_csv(index=False),
    "german": drive.to_csv(sep=";", decimal=",", index=False),
    "nanoseconds": drive.assign(t=dates.astype("int64").astype(str)).rename(columns={"t": "timestamp"}).to_csv(sep="\t", quoting=1),
    "merged": odometry.join(other.set_index("t").add_prefix("gt_"), how="outer").to_csv(),
}
(SCRIPT_DIRECTORY / "tables.json").write_text(json.dumps({name: text.splitlines() for name, text in TABLES.items()}, indent=0) + "\n")
