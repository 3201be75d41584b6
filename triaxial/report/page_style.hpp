#pragma once
// The page's style sheet: light, for screens from a telephone to a desk and for paper.

#include <string_view>

namespace grainfield::triaxial::report {

inline constexpr std::string_view page_style = R"css(
:root { --ink: #243039; --muted: #5d6973; --line: #d8dee3; --faint: #f5f7f8; --main: #1d4f7c; }
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; }
body { margin: 0; background: #fff; color: var(--ink);
       font: 16px/1.5 "Source Sans 3", "Helvetica Neue", Helvetica, Arial, "Liberation Sans",
             "DejaVu Sans", sans-serif; }
main { max-width: 1040px; margin: 0 auto; padding: 40px 24px 64px; }
header { border-top: 3px solid var(--main); padding-top: 14px; margin-bottom: 26px; }
h1, h2, .lead { font-family: Charter, "Bitstream Charter", "Source Serif 4", Georgia,
                "Liberation Serif", "DejaVu Serif", serif; }
.kicker, h1, h2, figcaption, p { overflow-wrap: anywhere; }
.kicker { margin: 0; color: var(--main); font-size: 13px; letter-spacing: .04em; }
h1 { font-size: 29px; line-height: 1.2; font-weight: 600; margin: 6px 0 10px; }
.lead { font-size: 18px; line-height: 1.5; margin: 0; max-width: 52em; }
h2 { font-size: 20px; font-weight: 600; margin: 42px 0 14px; padding-bottom: 5px;
     border-bottom: 1px solid var(--line); }
p.note { color: var(--muted); max-width: 46em; }
p.warning { border-left: 3px solid #b4581d; background: #fbf4ee; padding: 9px 14px; }
.tables { columns: 2; column-gap: 40px; }
table { width: 100%; border-collapse: collapse; margin: 0 0 26px; break-inside: avoid;
        font-size: 14.5px; }
caption { text-align: left; font-weight: 600; padding: 0 0 5px; color: var(--main); }
table tr:first-child > * { border-top: 1.5px solid var(--ink); }
table tr:last-child > * { border-bottom: 1.5px solid var(--ink); }
th, td { padding: 4px 0; border-bottom: 1px solid var(--line); vertical-align: top; }
th { text-align: left; font-weight: 400; padding-right: 14px; }
th small { display: block; color: var(--muted); font-size: 12.5px; line-height: 1.35; }
td { text-align: right; font-variant-numeric: tabular-nums; overflow-wrap: anywhere;
     min-width: 7.5em; }
table.columns { font-size: 13.5px; break-inside: auto; }
table.columns th, table.columns td { padding: 4px 0 4px 14px; min-width: 0;
                                     overflow-wrap: normal; }
.scroll { overflow-x: auto; }
table.columns th:first-child { padding-left: 0; min-width: 9em; overflow-wrap: anywhere; }
table.columns thead th { text-align: right; color: var(--muted); vertical-align: bottom;
                         border-bottom: 1px solid var(--ink); }
table.columns thead th:first-child { text-align: left; }
table.columns tr { break-inside: avoid; }
code, pre, dl { font-family: ui-monospace, "SF Mono", Menlo, Consolas, "Liberation Mono",
                "DejaVu Sans Mono", monospace; }
code { font-size: .88em; }
.pair { display: grid; grid-template-columns: minmax(0, 1fr) minmax(0, 1fr); gap: 8px 32px;
        align-items: start; }
.pair figure:only-child { grid-column: 1 / -1; max-width: 640px; }
figure { margin: 0 0 22px; break-inside: avoid; }
figcaption { font-size: 14px; line-height: 1.45; color: var(--muted); max-width: 52em; }
figcaption b { color: var(--ink); }
.picture { margin-bottom: 6px; }
svg { display: block; width: 100%; height: auto; }
svg text, svg tspan { font-family: "Helvetica Neue", Helvetica, Arial, "Liberation Sans",
                      "DejaVu Sans", sans-serif; }
.sample .picture { display: flex; justify-content: center; gap: 24px; }
.sample img { display: block; height: auto; width: auto; max-width: 100%; max-height: 860px;
              min-width: 0; object-fit: contain; }
.sample img:not(:only-child) { max-width: calc(50% - 12px); }
pre { font-size: 12.5px; line-height: 1.45; background: var(--faint); border: 1px solid var(--line);
      padding: 12px 14px; margin: 0; max-height: 420px; overflow: auto;
      white-space: pre-wrap; overflow-wrap: anywhere; }
pre + dl { margin-top: 14px; }
dl { columns: 2; column-gap: 40px; font-size: 12.5px; margin: 0; }
dl div { display: flex; justify-content: space-between; gap: 16px; padding: 2px 0;
         border-bottom: 1px solid var(--line); break-inside: avoid; }
dt { color: var(--muted); }
dd { margin: 0; text-align: right; overflow-wrap: anywhere; }
@media screen and (max-width: 760px) {
  main { padding: 22px 14px 40px; }
  .tables, dl { columns: 1; }
  .pair { grid-template-columns: minmax(0, 1fr); }
  .wide .picture { overflow-x: auto; }
  .wide svg { min-width: 680px; }
  .sample .picture { flex-direction: column; align-items: center; }
  .sample img:not(:only-child) { max-width: 100%; }
}
@media print {
  @page { size: A4; margin: 16mm 15mm; }
  body { font-size: 10pt; }
  main { max-width: none; padding: 0; }
  .tables, .pair { column-gap: 24px; }
  h1 { font-size: 19pt; }
  h2 { font-size: 13pt; margin: 18pt 0 8pt; break-after: avoid; }
  .lead { font-size: 12pt; }
  table, table.columns { font-size: 9pt; }
  th small, figcaption { font-size: 8pt; }
  .sample img { max-height: 205mm; }
  pre { max-height: none; overflow: visible; font-size: 7.5pt; }
  dl { font-size: 7.5pt; }
}
)css";

}  // namespace grainfield::triaxial::report
