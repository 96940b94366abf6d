"""The paper as data: what it prints, what its formulas give, what is wrong and why.

T. V. Mumcu, K. K. Çandır, İ. Üstoğlu, "Symbolic Pole Assignment of 2DoF Conventional Helicopter". Our
copy is a text extraction with damaged formulas: where the damage could be the extraction's, it says
"in our copy". `printed` holds the numbers, `as_printed` the formulas, `errata` what is wrong with
`proofs`, `equations` every equation and figure, `reproduce` the table, `figures` Figs. 4 and 5.
"""
