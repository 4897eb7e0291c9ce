"""Mathematics that knows no truck: projections, colors of noise, counts, quantiles, threads."""
