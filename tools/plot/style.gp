# What all pictures share. A template sets width and height (points of 1/72 inch; a font of 12 points looks right),
# then loads this file. Change colours, fonts and line widths here.
#
# Variables: picture   file to write, ending in .svg, .png or .pdf
#            title     above the picture
#            unit_t, unit_z   units of the scene, behind the labels of the axes
if (!exists("picture")) picture = 'picture.svg'
if (!exists("title")) title = ''

set encoding utf8
ending = picture[strlen(picture)-3:]
if (ending eq '.png') {  # twice as many pixels as points
  set terminal pngcairo enhanced size 2*width,2*height font 'Sans,12' fontscale 1.8 linewidth 2 pointscale 2
} else { if (ending eq '.pdf') {
  set terminal pdfcairo enhanced size width/72.0,height/72.0 font 'Sans,11' linewidth 1.3
} else {
  set terminal svg enhanced size width,height font 'sans-serif,11' background rgb 'white'
} }
set output picture

# Okabe and Ito's colours, told apart with every kind of colour vision.
blue = '#0072b2'
colours = '#0072b2 #d55e00 #009e73 #cc79a7 #e69f00 #56b4e9 #7f7f7f'
grey = '#a0a0a0'
dark_grey = '#404040'
# Plasma without its light end: even steps in lightness, readable on white, safe for colour-blind readers.
phi_palette = "0 '#0d0887', 0.25 '#6a00a8', 0.5 '#b12a90', 0.75 '#e16462', 1 '#f0a028'"
residual_palette = "0 '#2166ac', 0.25 '#67a9cf', 0.5 '#f7f7f7', 0.75 '#ef8a62', 1 '#b2182b'"  # ColorBrewer's RdBu

# Units of the scene; empty where it has none.
if (!exists("unit_t")) unit_t = ''
if (!exists("unit_z")) unit_z = ''
label(name, unit) = unit eq '' ? name : name . ' (' . unit . ')'

min(a, b) = a < b ? a : b
max(a, b) = a > b ? a : b
clamp(x, low, high) = min(max(x, low), high)
# The smallest of 1, 2, 5, 10, ... times a power of ten that is >= x.
round_up_with(x, power) = x <= 1.0001 * power ? power : x <= 2.0001 * power ? 2 * power : x <= 5.0001 * power ? 5 * power : 10 * power
round_up(x) = round_up_with(x, 10**floor(log10(x)))

load 'panel.gp'
