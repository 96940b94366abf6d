"""The derivation, in SymPy only: from energies to the linear model, K, Ĝ(s) and the RGA."""
