"""How the report looks, on a screen and on paper."""

STYLE = """
:root { color-scheme: light; }
body { max-width: 46rem; margin: 2rem auto; padding: 0 1rem; background: #fff; color: #111;
  font: 15px/1.45 system-ui, sans-serif; }
h1 { margin: 0 0 .2rem; font-size: 1.6rem; }
h2 { margin: 1.6rem 0 .5rem; border-bottom: 1px solid #999; font-size: 1.15rem; }
.about, figcaption, caption { color: #444; font-size: .87rem; }
caption { padding-bottom: .2rem; text-align: left; }
.fields { display: flex; gap: 2rem; margin: 1rem 0; }
.fields span { flex: 1; border-bottom: 1px solid #777; padding-bottom: .2rem; }
.wide { margin: .5rem 0; overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { padding: .15rem .9rem .15rem 0; text-align: left; vertical-align: top; }
thead th { border-bottom: 1px solid #999; }
tbody th { font-weight: 400; }
.plots { display: grid; grid-template-columns: repeat(2, minmax(0, 1fr)); gap: .6rem 1rem; }
figure { margin: 0; break-inside: avoid; }
svg { width: 100%; height: auto; font: 10px system-ui, sans-serif; }
svg .pole { fill: none; stroke: #111; stroke-width: 1.5; }
svg .pitch, svg .pitch-linear { fill: none; stroke: #b94a2c; stroke-width: 2.2; }
svg .yaw, svg .yaw-linear { fill: none; stroke: #24689b; stroke-width: 1.3; }
svg .pitch-linear { stroke-width: 1.4; stroke-dasharray: 6 3; }
svg .yaw-linear { stroke-dasharray: 1.5 2.5; }
svg .mark { fill: none; stroke: #555; stroke-dasharray: 1.5 2.5; }
svg .grid { stroke: #e4e4e4; }
svg .axis { fill: none; stroke: #555; }
.formula { margin: .5rem 0; overflow-x: auto; overflow-y: hidden; }
math { font-size: 1.05em; }
/* Brackets as tall as their matrix, also where no font for mathematics is installed. */
math mo:has(+ mtable), math mtable + mo { display: none; }
mtable { margin-left: .2em; padding: .1em .25em; border: solid #111; border-width: 0 1.3px;
  background: linear-gradient(#111, #111) left top, linear-gradient(#111, #111) left bottom,
    linear-gradient(#111, #111) right top, linear-gradient(#111, #111) right bottom;
  background-size: .35em 1.3px; background-repeat: no-repeat; print-color-adjust: exact; }
pre { white-space: pre-wrap; overflow-wrap: anywhere; font-size: .8rem; }
a { color: #0b5ea8; overflow-wrap: anywhere; }
@media (max-width: 560px) { .plots { grid-template-columns: minmax(0, 1fr); } }
@page { size: A4; margin: 16mm 15mm; }
@media print {
  body { max-width: none; margin: 0; padding: 0; font-size: 10pt; }
  a { color: inherit; }
  h2, .before { break-after: avoid; }
  table, .formula, li { break-inside: avoid; }
  .wide, .formula { overflow: visible; }
}
"""
