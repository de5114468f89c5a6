"""Simulates homes with sensors and the people in them.

>>> import homebody as hb
>>> home = hb.scenario("studio")
>>> run = home.run(days=1, seed=7)
>>> run.events, run.activities
(<homebody.Table: ... rows of time, device, value>, <homebody.Table: ... rows of start_time, end_time, activity, resident>)
"""

from homebody._homebody import VERSION as __version__
from homebody._cohort import Cohort, cohort
from homebody.driver import Away, Doing, Driver, Rest, Stir, Stride, Surroundings, Use
from homebody.errors import (
    ClusterError,
    DriverError,
    Exists,
    HomebodyError,
    LogError,
    MissingPackage,
    ModelError,
    Problem,
    ScenarioError,
    Stopped,
)
from homebody.free_text import ConversationRound, DraftRow, DraftStatement, FreeTextLife, life_from, life_prompt
from homebody.live import Live
from homebody.log import Comparison, Log, compare, read, translate
from homebody.picture import Answer, Picture
from homebody.profiles import draw
from homebody.scenario import Plan, Run, Scenario, scenario, templates
from homebody.statements import away, change, habit, life, sleep, visit
from homebody.table import Table

__all__ = [
    "Answer",
    "Away",
    "ClusterError",
    "Cohort",
    "Comparison",
    "ConversationRound",
    "Doing",
    "DraftRow",
    "DraftStatement",
    "Driver",
    "DriverError",
    "Exists",
    "FreeTextLife",
    "HomebodyError",
    "Live",
    "Log",
    "LogError",
    "MissingPackage",
    "ModelError",
    "Picture",
    "Plan",
    "Problem",
    "Rest",
    "Run",
    "Scenario",
    "ScenarioError",
    "Stir",
    "Stopped",
    "Stride",
    "Surroundings",
    "Table",
    "Use",
    "__version__",
    "away",
    "change",
    "cohort",
    "compare",
    "draw",
    "habit",
    "life",
    "life_from",
    "life_prompt",
    "read",
    "scenario",
    "sleep",
    "templates",
    "translate",
    "visit",
]
