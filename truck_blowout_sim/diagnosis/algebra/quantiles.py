"""Quantiles that intervals are made of."""

from __future__ import annotations

NINETY = 1.645  # standard errors to either side that hold 90 % of a normal variable
