"""The concealed-effect benchmark: cases with sealed answers, diagnosed and scored.

`prove` walks cases, `score` judges one answer, `summary` counts. Recordings come from folders on
disk; the program that makes them is started as a process of its own and never imported.
"""
