# What all pictures share. A template sets width and height (points of 1/72 inch; a font of 12 points looks right),
# then loads this file. Change colours, fonts and line widths here.
#
# Variables: picture   file to write, ending in .svg, .png or .pdf
#            title     above the picture
#            subtitle  small, below it: method and resolution
#            unit_t, unit_z   units of the scene, behind the labels of the axes
#            along     what the solution goes on in: t, or x in a steady chute
#            is_panels 1 for a template of several panels
#            width_cm, height_cm   of the picture, instead of those of the template
#            dpi       pixels per inch of a .png
if (!exists("picture")) picture = 'picture.svg'
if (!exists("title")) title = ''
if (!exists("subtitle")) subtitle = ''
if (!exists("dpi")) dpi = 144
min(a, b) = a < b ? a : b
max(a, b) = a > b ? a : b

# Letters become smaller more slowly than the picture.
scale = 1.0
if (exists("width_cm")) {
  scale = width_cm / 2.54 * 72 / width
  height = exists("height_cm") ? height_cm / 2.54 * 72 : height * scale
  width = width * scale
}
if (!exists("is_panels")) is_panels = 0  # 1: many small ones, whose letters have no room to stay large
letters = is_panels ? 11 * scale : max(6.5, 11 * min(1.2, sqrt(scale)))
lines = max(0.5, min(1.2, sqrt(scale)))

set encoding utf8
ending = picture[strlen(picture)-3:]
if (ending eq '.png') {
  pixels = dpi / 72.0
  if (strstrt(GPVAL_TERMINALS, ' pngcairo ') > 0) {
    set terminal pngcairo enhanced size ceil(pixels*width),ceil(pixels*height) font sprintf('Sans,%.2f', letters * 0.98) fontscale pixels linewidth pixels*lines pointscale pixels*lines
  } else {
    print 'shearfront: this gnuplot has no cairo: a plain .png, without transparency and with coarser letters'
    set terminal png enhanced size ceil(pixels*width),ceil(pixels*height) font ',11' linewidth pixels*lines
  }
} else { if (ending eq '.pdf') {
  set terminal pdfcairo enhanced size width/72.0,height/72.0 font sprintf('Sans,%.2f', letters) linewidth 1.3*lines
} else {
  set terminal svg enhanced size width,height font sprintf('sans-serif,%.2f', letters) linewidth lines background rgb 'white'
} }
# A long title becomes several lines.
if (!exists("title_share") || scale < 0.75) title_share = 1.0  # of the width, where it stands beside the middle
longest_line = floor(1.2 * title_share * width / letters)
if (strlen(title) > longest_line) {
  wrapped = ''
  line = ''
  do for [w in title] {
    if (line ne '' && strlen(line) + 1 + strlen(w) > longest_line) { wrapped = wrapped . line . "\n"; line = w } else { line = line eq '' ? w : line . ' ' . w }
  }
  title = wrapped . line
}
set output picture

# Okabe and Ito's colours, told apart with every kind of colour vision.
blue = '#0072b2'
colours = '#0072b2 #d55e00 #009e73 #cc79a7 #e69f00 #56b4e9 #7f7f7f'
# As many as can be told apart on one page: those, and five of Tol's.
many_colours = colours . ' #882255 #999933 #44aa99 #332288 #aa4466'
grey = '#a0a0a0'
dark_grey = '#404040'
# Plasma without its light end: even steps in lightness, readable on white, safe for colour-blind readers.
phi_palette = "0 '#0d0887', 0.25 '#6a00a8', 0.5 '#b12a90', 0.75 '#e16462', 1 '#f0a028'"
residual_palette = "0 '#2166ac', 0.25 '#67a9cf', 0.5 '#f7f7f7', 0.75 '#ef8a62', 1 '#b2182b'"  # ColorBrewer's RdBu

# Units of the scene; empty where it has none.
if (!exists("unit_t")) unit_t = ''
if (!exists("unit_z")) unit_z = ''
if (!exists("along")) along = 't'
along_name = (along eq 'x' ? 'distance' : 'time') . ' {/:Italic ' . along . '}'
label(name, unit) = unit eq '' ? name : name . ' (' . unit . ')'

clamp(x, low, high) = min(max(x, low), high)
# The smallest of 1, 2, 5, 10, ... times a power of ten that is >= x.
round_up_with(x, power) = x <= 1.0001 * power ? power : x <= 2.0001 * power ? 2 * power : x <= 5.0001 * power ? 5 * power : 10 * power
round_up(x) = round_up_with(x, 10**floor(log10(x)))

is_narrow = scale < 0.75
# Steps of tics that leave room for their labels.
steps_of(range) = round_up(range / (is_narrow ? 5.0 : 7.0))
# Right above the axes, in a line that the title leaves free; above everything where there are panels.
if (!exists("is_subtitle_below")) is_subtitle_below = 0
if (subtitle ne '' && !is_panels && !is_subtitle_below) title = title . "\n"
subtitle_font = sprintf(',%.2f', 0.75 * letters)
set_subtitle = "if (subtitle ne '') { if (is_panels || is_subtitle_below) { set label 1000 subtitle noenhanced at screen 0.995,(is_panels ? (is_subtitle_below ? 0.012 : 0.985) : 0.025) right font subtitle_font textcolor rgb '#707070' front } " .\
  "else { set label 1000 subtitle noenhanced at graph 1,1 right offset 0,0.55 font subtitle_font textcolor rgb '#707070' front } }"

load 'panel.gp'
eval set_subtitle
