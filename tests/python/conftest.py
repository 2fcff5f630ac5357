"""Figures are drawn without a screen, and a float that stands for a decimal is no error here unless a test says so."""
import os
import warnings

import pytest

os.environ["MPLBACKEND"] = "Agg"


@pytest.fixture(autouse=True)
def floats_are_warned_of_again():
    import hbvm._number

    hbvm._number._warned_of_floats = False
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.filterwarnings("ignore", module="(matplotlib|pandas|dateutil|pytz|pyparsing).*")
        warnings.filterwarnings("ignore", category=DeprecationWarning)
        yield
