"""Verdict, words and what stands behind them."""
