#pragma once

#include <string_view>

namespace raywatch {

/// The style sheet of a report: for screens from 360 px on, and for A4.
inline constexpr std::string_view kReportStyle = R"css(
@page { size: A4; margin: 15mm 14mm 16mm; }
* { box-sizing: border-box; print-color-adjust: exact; -webkit-print-color-adjust: exact; }
body { margin: 0 auto; max-width: 1040px; padding: 24px 28px 48px; color: #1c2126; background: #fff;
  font: 14px/1.5 system-ui, -apple-system, "Segoe UI", "DejaVu Sans", sans-serif; }
header { border-bottom: 2px solid #1c2126; padding-bottom: 12px; margin-bottom: 18px; }
h1 { font-size: 24px; line-height: 1.25; margin: 0 0 4px; }
h2 { font-size: 17px; margin: 30px 0 10px; padding-bottom: 4px; border-bottom: 1px solid #d4d8dc; break-after: avoid; }
h3 { font-size: 14px; margin: 18px 0 6px; break-after: avoid; }
p { margin: 6px 0; max-width: 76ch; }
.sub, .note, small { color: #59636e; }
.note { font-size: 12.5px; }
.lead { font-size: 16px; }
.warnings { border-left: 4px solid #b35900; background: #fff6ea; padding: 8px 14px; margin: 14px 0; }
.warnings ul { margin: 4px 0; padding-left: 20px; }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(176px, 1fr)); gap: 10px; margin: 16px 0; }
.tile { border: 1px solid #d4d8dc; border-radius: 6px; padding: 10px 12px; break-inside: avoid; }
.tile b { display: block; font-size: 21px; line-height: 1.3; font-variant-numeric: tabular-nums; }
.tile span { font-size: 12px; color: #59636e; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: 12.5px; margin: 6px 0 10px; }
th { text-align: left; font-weight: 600; color: #414a53; border-bottom: 1.5px solid #8b949e; vertical-align: bottom; }
th, td { padding: 5px 8px 5px 0; }
td { border-bottom: 1px solid #e4e7ea; vertical-align: top; font-variant-numeric: tabular-nums; }
tr { break-inside: avoid; }
td small { display: block; font-size: 11.5px; }
table.basis code { font: 10.5px ui-monospace, "DejaVu Sans Mono", monospace; word-break: break-all; }
.maps { display: flex; flex-wrap: wrap; gap: 22px 26px; align-items: flex-start; }
figure { margin: 0; break-inside: avoid; }
figure { max-width: 100%; }
figure.large { flex: 0 0 100%; }
.plate { display: flex; flex-wrap: wrap; gap: 14px 18px; align-items: flex-start; }
figcaption { font-weight: 600; margin-bottom: 6px; }
svg.map { display: block; max-width: 100%; height: auto; outline: 1px solid #d4d8dc; }
svg.map image { image-rendering: pixelated; }
svg.map .zone { fill: none; stroke: #111; stroke-width: 1.4; vector-effect: non-scaling-stroke; }
svg.map .halo { fill: none; stroke: #fff; stroke-width: 3.4; vector-effect: non-scaling-stroke; stroke-opacity: .8; }
svg.map .station { fill: #fff; stroke: #111; stroke-width: 1.4; vector-effect: non-scaling-stroke; }
svg.map text { font-family: system-ui, "DejaVu Sans", sans-serif; font-weight: 600; fill: #111; paint-order: stroke;
  stroke: #fff; stroke-opacity: .85; stroke-linejoin: round; }
svg.map .ruler { fill: #111; stroke: #fff; stroke-width: 1; vector-effect: non-scaling-stroke; }
.legend { list-style: none; margin: 0; padding: 0; font-size: 12px; flex: 0 0 auto; }
.legend.below { margin-top: 8px; }
.legend li { display: flex; align-items: center; gap: 8px; line-height: 1.65; }
.legend svg { width: 20px; height: 13px; flex: none; border: 1px solid #b4bac0; }
.trends { display: grid; grid-template-columns: repeat(auto-fill, minmax(290px, 1fr)); gap: 14px 22px; }
svg.trend { display: block; width: 100%; }
svg.trend text { font: 10px system-ui, "DejaVu Sans", sans-serif; fill: #59636e; }
svg.trend .grid { stroke: #e4e7ea; } svg.trend .zero { stroke: #8b949e; }
svg.trend .bar { stroke: #7ba7d0; stroke-width: 3; } svg.trend .way { fill: none; stroke: #215f9d; stroke-width: 1.2; }
svg.trend .dot { fill: #215f9d; }
.none { color: #59636e; font-style: italic; }
footer { margin-top: 30px; border-top: 1px solid #d4d8dc; padding-top: 8px; font-size: 12px; color: #59636e; }
@media (max-width: 520px) { body { padding: 16px 14px 32px; } h1 { font-size: 20px; } .legend { width: 100%; }
  .wide table { min-width: 600px; } }
@media print { body { padding: 0; max-width: none; font-size: 11px; } .lead { font-size: 13px; } h1 { font-size: 20px; }
  h2 { font-size: 14px; margin-top: 20px; } table { font-size: 9.5px; } td small { font-size: 8.8px; }
  .wide { overflow: visible; } .maps { gap: 14px; } figure.large svg.map { width: auto; max-width: 122mm;
  max-height: 148mm; } table.basis { break-inside: avoid; } figure.small svg.map { width: auto;
  max-width: 84mm; max-height: 84mm; } .tiles { grid-template-columns: repeat(4, 1fr); gap: 6px; }
  .tile { padding: 6px 8px; } .tile b { font-size: 14px; } .tile span { font-size: 9px; }
  .trends { grid-template-columns: 1fr 1fr 1fr; } table.basis code { font-size: 7.5px; } }
)css";

}  // namespace raywatch
