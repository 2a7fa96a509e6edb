; The objects that can be spawned. Units: m, rad, kg.
;
; Shapes are given in the object's frame (front +x, left +y, top +z); spawning sets the pose
; of its origin. They are: a box given by its edge lengths, a cylinder with its axis along z,
; a sphere, and a ring of equal boxes (staves, thickness x width x height) around :at, whose tops
; :lean outwards by that angle. :at and :rpy give the pose of the shape's centre; they and :lean
; default to zero.
; :inside says what is in something whose solids are closed, behind the middle of its top: an (opening :radius :wall) once
; it has been filled, which is to open it, or (holes :radius :wall :portion) out of which a portion (ml) falls each
; time it is shaken; walls, bottom and top are so thick (m).
; Colours are linear red, green, blue and optionally alpha.

; The types that list-available-objects returns, in that order.
(available tray tray-base spoon red-metal-plate milk cup cube cereal buttermilk
           breakfast-cereal bottle blue-metal-plate mug plate mondamin pot weisswurst bowl
           fork knife spatula cap glasses glove shoe)

; Types and their kinds; an object of a kind may be used wherever its type is asked for.
(kinds household-item kitchen-item clothing-item wiping-tool stirring-tool shaker)
(kinds kitchen-item cutlery plate tray bottle cup milk cereal bowl open-box pot spatula)
(kinds food bread weisswurst)
(kinds cutlery knife fork spoon)
(kinds cereal breakfast-cereal)
(kinds cup mug)
(kinds clothing-item shoe)
(kinds wiping-tool sponge)
(kinds knife big-knife)
(kinds stirring-tool whisk ladle)
(kinds shaker salt-shaker)
(kinds bread bread-slice)
(kinds weisswurst weisswurst-slice)
(kinds apple apple-slice)
(kinds orange orange-slice)

(object tray :mass 0.2 :color (0.5 0.5 0.5)
 :shapes
  ((box :size (0.396 0.352 0.0053) :at (0 -0.004 0.0034))
   (box :size (0.0245 0.365 0.0207) :at (-0.2102 -0.002 0.0143))
   (box :size (0.0245 0.365 0.0207) :at (0.2102 -0.002 0.0143))
   (box :size (0.396 0.0125 0.0207) :at (0 -0.1782 0.0143))
   (box :size (0.396 0.0155 0.0207) :at (0 0.1728 0.0143))))

(object tray-base :mass 0.2 :color (0.5 0.5 0.5)
 :shapes
  ((box :size (0.22 0.22 0.0223) :at (0 0 0.0116))))

; Lying, its long axis along x.
(object spoon :mass 0.2 :color (0.5 0.5 0.5)
 :shapes
  ((box :size (0.1655 0.016 0.008) :at (-0.0278 0 -0.0005))
   (box :size (0.0513 0.0462 0.0189) :at (0.0806 -0.0001 0.0032))))

(object red-metal-plate :mass 0.2 :color (0.5 0.5 0.5)
 :shapes
  ((cylinder :radius 0.088 :length 0.005 :at (0 0 -0.0108))
   (ring :count 12 :radius 0.097 :stave (0.022 0.0579 0.01) :at (0 0 -0.0043))
   (ring :count 12 :radius 0.1183 :stave (0.025 0.0701 0.0096) :at (0 0 0.0045))))

; A slim carton with a low gable top.
(object milk :mass 0.2 :color (0.12 0.22 0.42) :inside (opening :radius 0.014 :wall 0.001)
 :shapes
  ((box :size (0.0765 0.0761 0.205) :at (0.0018 -0.0009 -0.01))
   (box :size (0.066 0.05 0.0235) :at (0.001 0 0.1042))))

; A beaker, open at the top.
(object cup :mass 0.2 :color (1 0.64 0.293)
 :shapes
  ((cylinder :radius 0.0325 :length 0.006 :at (0.001 -0.0005 -0.0392))
   (ring :count 8 :radius 0.0324 :stave (0.0056 0.0292 0.041) :at (0.0015 -0.0007 -0.0157))
   (ring :count 8 :radius 0.0371 :stave (0.0062 0.0340 0.0407) :at (0.0019 -0.0009 0.0251))))

(object cube :mass 0.2 :color (0.5 0.5 0.5)
 :shapes
  ((box :size (0.07 0.07 0.07))))

(object cereal :mass 0.2 :color (0.5 0.5 0.5)
 :inside (opening :radius 0.024 :wall 0.002)
 :shapes
  ((box :size (0.1474 0.058 0.2236) :at (-0.0012 -0.001 0.0099))))

(object buttermilk :mass 0.2 :color (0.5 0.5 0.5)
 :shapes
  ((cylinder :radius 0.0374 :length 0.1 :at (0.0005 -0.0001 -0.0292))
   (cylinder :radius 0.029 :length 0.03 :at (0.0005 -0.0001 0.0358))
   (cylinder :radius 0.021 :length 0.0427 :at (0.0005 -0.0001 0.0721))))

(object breakfast-cereal :mass 0.2 :color (0.5 0.5 0.21)
 :inside (opening :radius 0.024 :wall 0.002)
 :shapes
  ((box :size (0.1474 0.058 0.2236) :at (-0.0012 -0.001 0.0099))))

; Upright, with a short shoulder and neck; its bottom is 0.1008 below its origin.
(object bottle :mass 0.2 :color (0.5 0.5 0.5) :inside (opening :radius 0.011 :wall 0.002)
 :shapes
  ((cylinder :radius 0.0357 :length 0.151 :at (0.0005 -0.0007 -0.0253))
   (cylinder :radius 0.031 :length 0.011 :at (0.0005 -0.0007 0.0557))
   (cylinder :radius 0.0178 :length 0.0195 :at (0.0005 -0.0007 0.0709))))

(object blue-metal-plate :mass 0.2 :color (0.5 0.5 0.5)
 :shapes
  ((cylinder :radius 0.06 :length 0.005 :at (0.0001 0.0018 -0.0162))
   (ring :count 12 :radius 0.067 :stave (0.024 0.0423 0.018) :at (0.0001 0.0018 -0.0057))
   (ring :count 12 :radius 0.0937 :stave (0.032 0.0588 0.0126) :at (0.0001 0.0018 0.0096))))

; Its handle points along x.
(object mug :mass 0.2 :color (0.8 0.3 0)
 :shapes
  ((cylinder :radius 0.041 :length 0.008 :at (0 0 -0.0546))
   (ring :count 8 :radius 0.0383 :stave (0.006 0.0342 0.088) :at (0 0 -0.0066))
   (box :size (0.039 0.012 0.008) :at (0.0595 0 0.0234))
   (box :size (0.039 0.012 0.008) :at (0.0595 0 -0.0426))
   (box :size (0.0109 0.012 0.058) :at (0.0764 0 -0.0096))))

(object plate :mass 0.2 :color (0.8 0.58 0.35)
 :shapes
  ((cylinder :radius 0.087 :length 0.008 :at (0 0 -0.0022))
   (ring :count 12 :radius 0.095 :stave (0.02 0.0563 0.01) :at (0 0 0.0048))
   (ring :count 12 :radius 0.1155 :stave (0.026 0.0689 0.0081) :at (0 0 0.0119))))

; A flat bottle.
(object mondamin :mass 0.2 :color (0.5 0.1 0)
 :shapes
  ((box :size (0.0932 0.054 0.188) :at (0 0 -0.012))
   (cylinder :radius 0.025 :length 0.024 :at (0 0 0.094))))

; Its two handles stick out along y.
(object pot :mass 0.2 :color (0.1 0.2 0.3)
 :shapes
  ((cylinder :radius 0.125 :length 0.006 :at (0 0 -0.087))
   (ring :count 12 :radius 0.1225 :stave (0.005 0.067 0.154) :at (0 0 -0.007))
   (box :size (0.09 0.069 0.025) :at (0 -0.157 0.0575))
   (box :size (0.09 0.069 0.025) :at (0 0.157 0.0575))))

; Lying, slightly curved.
(object weisswurst :mass 0.2 :color (0.5 0.1 0)
 :shapes
  ((cylinder :radius 0.0158 :length 0.037 :at (-0.0365 -0.0105 0) :rpy (0 1.5707963267948966 0))
   (cylinder :radius 0.0158 :length 0.036 :at (0 0.0012 0) :rpy (0 1.5707963267948966 0))
   (cylinder :radius 0.0158 :length 0.037 :at (0.0365 -0.0105 0) :rpy (0 1.5707963267948966 0))))

(object bowl :mass 0.2 :color (0 0.3 0)
 :shapes
  ((cylinder :radius 0.042 :length 0.006 :at (0 0 -0.0301))
   (ring :count 8 :radius 0.0571 :stave (0.006 0.064 0.056) :lean 0.6632 :at (0 0 -0.0088))
   (ring :count 8 :radius 0.077 :stave (0.006 0.0663 0.023) :at (0 0 0.0204))))

; Lying, its long axis along y.
(object fork :mass 0.2 :color (0.2 0.1 0.3)
 :shapes
  ((box :size (0.0189 0.1107 0.0102) :at (0 -0.0003 0.0013))
   (box :size (0.0189 0.0547 0.0102) :at (0 0.0824 0.0013))))

; Lying, its long axis along y.
(object knife :mass 0.2 :color (0.5 0 0)
 :shapes
  ((box :size (0.019 0.1796 0.0079) :at (0.0014 -0.0023 0.0002))))

; Lying, its long axis along x.
(object spatula :mass 0.2 :color (0.1 0.1 0.1)
 :shapes
  ((box :size (0.2325 0.024 0.0154) :at (-0.0462 0 -0.0027))
   (box :size (0.0957 0.049 0.0163) :at (0.1178 0 0.0022))))

(object cap :mass 0.2 :color (0.5 0.5 0.5)
 :shapes
  ((cylinder :radius 0.0436 :length 0.0444 :at (0 0.0127 0.0224))
   (box :size (0.07 0.045 0.0118) :at (0 -0.0525 0.0061))))

(object glasses :mass 0.2 :color (0.5 0.5 0.5)
 :shapes
  ((box :size (0.0926 0.0602 0.0186) :at (0 0.0006 0.0091))))

(object glove :mass 0.2 :color (0.5 0.5 0.5)
 :shapes
  ((box :size (0.0988 0.0498 0.0336) :at (0.0099 0.0005 0.0149))))

(object shoe :mass 0.2 :color (0.5 0.5 0.5)
 :shapes
  ((box :size (0.0572 0.1397 0.05) :at (0 -0.0311 0.025))
   (box :size (0.0572 0.0698 0.0437) :at (0 0.0039 0.0718))))

; Objects that can be spawned, but are not listed.

(object bread :mass 0.2 :color (0.5 0.1 0)
 :shapes
  ((box :size (0.2622 0.0972 0.065) :at (0.003 -0.0006 0.0032))))

; Standing on its edge, as it is cut off; so are the slices of what is round.
(object bread-slice :mass 0.02 :color (0.5 0.1 0)
 :shapes
  ((box :size (0.02 0.0972 0.065))))

(object weisswurst-slice :mass 0.03 :color (0.5 0.1 0)
 :shapes
  ((cylinder :radius 0.0158 :length 0.02 :rpy (0 1.5707963267948966 0))))

(object apple-slice :mass 0.05 :color (0.5 0.5 0.5)
 :shapes
  ((cylinder :radius 0.035 :length 0.02 :rpy (0 1.5707963267948966 0))))

(object orange-slice :mass 0.05 :color (0.5 0.5 0.5)
 :shapes
  ((cylinder :radius 0.033 :length 0.02 :rpy (0 1.5707963267948966 0))))

; For wiping: full of water, with the soft side below.
(object sponge :mass 0.3 :friction 0.4 :color (0.8 0.6 0.06)
 :shapes
  ((box :size (0.11 0.075 0.04))))

(object cutting-board :mass 1.8 :friction 0.8 :color (0.45 0.24 0.09)
 :shapes
  ((box :size (0.4 0.28 0.04))))

; Lying, its long axis along y, the wires at +y.
(object whisk :mass 0.12 :color (0.06 0.06 0.065)
 :shapes
  ((box :size (0.024 0.13 0.03) :at (0 -0.015 0))
   (cylinder :radius 0.015 :length 0.13 :at (0 0.115 0) :rpy (1.5707963267948966 0 0))))

; Lying, its long axis along y, the round bowl of the ladle at +y, its open side up.
(object ladle :mass 0.15 :color (0.35 0.36 0.37)
 :shapes
  ((box :size (0.022 0.16 0.016) :at (0 -0.03 0.01))
   (cylinder :radius 0.026 :length 0.004 :at (0 0.082 -0.018))
   (ring :count 8 :radius 0.0285 :stave (0.003 0.0236 0.032) :at (0 0.082 0))))

; A cylinder with a domed lid, in whose middle are holes. Two tenths of a gram, 0.17 ml, fall at a time.
(object salt-shaker :mass 0.15 :color (0.7 0.71 0.72) :inside (holes :radius 0.014 :wall 0.002 :portion 0.17)
 :shapes
  ((cylinder :radius 0.023 :length 0.095 :at (0 0 -0.0075))
   (cylinder :radius 0.018 :length 0.015 :at (0 0 0.0475))))

; Lying, its long axis along y and its edge at +x; the weight is in the handle.
(object big-knife :mass 0.2 :color (0.06 0.06 0.065)
 :shapes
  ((box :size (0.03 0.13 0.02) :at (0 -0.015 0))
   (box :size (0.057 0.25 0.0024) :at (0.0165 0.175 -0.0088))))

(object open-box :mass 0.2 :color (0.5 0.5 0.5)
 :shapes
  ((box :size (0.5 0.5 0.01) :at (0 0 -0.095))
   (box :size (0.01 0.5 0.19) :at (-0.245 0 0.005))
   (box :size (0.01 0.5 0.19) :at (0.245 0 0.005))
   (box :size (0.48 0.01 0.19) :at (0 -0.245 0.005))
   (box :size (0.48 0.01 0.19) :at (0 0.245 0.005))))

(object pancake-maker :mass 0.2 :color (0.15 0.15 0.15)
 :shapes
  ((cylinder :radius 0.15 :length 0.07)))

(object orange :mass 0.2 :color (0.5 0.5 0.5)
 :shapes
  ((sphere :radius 0.04)))

(object apple :mass 0.2 :color (0.5 0.5 0.5)
 :shapes
  ((sphere :radius 0.0425)))

(object sugar-box :mass 0.2 :color (0.5 0.5 0.5)
 :shapes
  ((box :size (0.055 0.094 0.207))))

(object cereal-box :mass 0.2 :color (0.5 0.5 0.5)
 :shapes
  ((box :size (0.058 0.193 0.277))))

(object visualization-box :mass 0.2 :color (1 0 0 0.5)
 :shapes
  ((box :size (0.06 0.02 0.02))))
