; How things look: surfaces by which people recognise what the world knows as a few boxes and
; cylinders. Looks have no effect on anything: neither physics nor the robot's camera knows of
; them. Units: m, in the frame of the link or object.
;
; (object TYPE … :surfaces …)     replaces the shapes of objects of these types; a type without
;                                 a record looks as its shapes, rings of boxes as round vessels.
; (link NAME … :of ROBOT …)       replaces the visual shapes of links of the robot of that name.
; (furniture NAME … :surfaces …)  is shown in addition to the visual shapes of the furniture.
;
; Surfaces; :axis is x, y or z, and what is said across the axis is in the next two axes: y z
; for x, z x for y, x y for z. :at is the place of the axis, by default the origin.
; (turned :axis :line ((distance along) …))  the surface of revolution of a line
; (disc :axis :span (from to) :radius)       a disc or cylinder with bevelled edges
; (bar :axis :span (from to) :half (a b) :round)  a straight body, half its widths, and the
;                                            radius of its edges
; (lofted :axis :sections ((along (half half) round (at at)) …) :ends (from to))
;                                            a body through rounded rectangles; its ends are
;                                            rounded by so much
; (tube :path (((x y z) radius) …) :up (x y z))  a round tube; :up is across its path
; (vessel)                                   the round vessel that the rings of boxes among an
;                                            object's shapes stand for
;
; :color is a name or linear red, green, blue and optionally alpha; without it a surface has the
; colour of its object, or the one that :own gives for each of the links named.

(colors
 (white (0.80 0.80 0.775))
 (silver (0.50 0.51 0.52))
 (steel (0.48 0.49 0.50))
 (grey (0.22 0.225 0.235))
 (dark (0.055 0.057 0.062))
 (black (0.018 0.018 0.02))
 (red (0.55 0.02 0.02))
 (blue (0.015 0.16 0.42))
 (orange (0.72 0.20 0.01))
 (paper (0.80 0.79 0.74))
 (lid (0.82 0.82 0.80))
 (ink (0.03 0.03 0.033))
 (sun (0.80 0.42 0.03))
 (ring (0.16 0.16 0.165)))

; Objects.

(object bottle
 :surfaces
  ((turned :axis z :at (0.0005 -0.0007)
         :line ((0 -0.1008) (0.0315 -0.1008) (0.035 -0.0985) (0.0357 -0.0945) (0.0357 0.022)
                (0.035 0.031) (0.0328 0.0395) (0.029 0.047) (0.0235 0.053) (0.0185 0.057)
                (0.016 0.0605) (0.0152 0.064) (0 0.0645)))
   (turned :axis z :at (0.0005 -0.0007) :color lid
         :line ((0 0.0625) (0.017 0.0625) (0.0176 0.0635) (0.0176 0.078) (0.0166 0.08)
                (0.0145 0.0807) (0 0.0807)))
   (turned :axis z :at (0.0005 -0.0007) :color paper
         :line ((0.0352 -0.08) (0.0361 -0.0795) (0.0361 -0.0385) (0.0352 -0.038)))))

(object buttermilk
 :surfaces
  ((turned :axis z :at (0.0005 -0.0001)
         :line ((0 -0.0792) (0.034 -0.0792) (0.0372 -0.076) (0.0374 -0.07) (0.0374 0.013)
                (0.0362 0.024) (0.0325 0.036) (0.027 0.049) (0.0215 0.06) (0.0195 0.068)
                (0 0.069)))
   (turned :axis z :at (0.0005 -0.0001) :color lid
         :line ((0 0.066) (0.021 0.066) (0.021 0.0905) (0.019 0.0934) (0 0.0934)))
   (turned :axis z :at (0.0005 -0.0001) :color paper
         :line ((0.037 -0.06) (0.0378 -0.0595) (0.0378 0.0055) (0.037 0.006)))))

; A flat bottle.
(object mondamin
 :surfaces
  ((lofted :axis z :ends (0.004 0)
         :sections ((-0.106 (0.044 0.025) 0.02)
                    (-0.09 (0.0466 0.027) 0.022)
                    (0.03 (0.0466 0.027) 0.022)
                    (0.06 (0.04 0.026) 0.022)
                    (0.082 (0.025 0.023) 0.022)))
   (turned :axis z :color lid
         :line ((0 0.08) (0.0245 0.08) (0.025 0.083) (0.0235 0.103) (0.0215 0.106) (0 0.106)))
   (lofted :axis z :color paper
         :sections ((-0.075 (0.0469 0.0273) 0.022)
                    (0.015 (0.0469 0.0273) 0.022)))))

; A carton with a gable.
(object milk
 :surfaces
  ((lofted :axis z
         :sections ((-0.1125 (0.0382 0.038) 0.003 (0.0018 -0.0009))
                    (0.0925 (0.0382 0.038) 0.003 (0.0018 -0.0009))))
   (lofted :axis z
         :sections ((0.0925 (0.0382 0.038) 0.003 (0.0018 -0.0009))
                    (0.11 (0.0382 0.004) 0.002 (0.0018 -0.0009))
                    (0.1159 (0.0382 0.0025) 0.001 (0.0018 -0.0009))))
   (lofted :axis z :color paper
         :sections ((-0.085 (0.0387 0.0385) 0.003 (0.0018 -0.0009))
                    (0.02 (0.0387 0.0385) 0.003 (0.0018 -0.0009))))
   (turned :axis z :at (0.0018 -0.019) :color lid
         :line ((0 0.096) (0.0125 0.096) (0.0125 0.111) (0.0115 0.1125) (0 0.1125)))))

; A box with a picture on it.
(object cereal breakfast-cereal
 :surfaces
  ((lofted :axis z :ends (0.001 0.001)
         :sections ((-0.1019 (0.0737 0.029) 0.001 (-0.0012 -0.001))
                    (0.1217 (0.0737 0.029) 0.001 (-0.0012 -0.001))))
   (lofted :axis z :color paper
         :sections ((0.0619 (0.074 0.0293) 0.001 (-0.0012 -0.001))
                    (0.0979 (0.074 0.0293) 0.001 (-0.0012 -0.001))))
   (turned :axis y :at (-0.0201 -0.0012) :color paper
         :line ((0 -0.0309) (0.046 -0.0309) (0.046 -0.0297) (0 -0.0297)))
   (turned :axis y :at (-0.0201 -0.0012) :color sun
         :line ((0 -0.0312) (0.034 -0.0312) (0.034 -0.0294) (0 -0.0294)))
   (turned :axis y :at (-0.0201 -0.0012) :color paper
         :line ((0 0.0277) (0.046 0.0277) (0.046 0.0289) (0 0.0289)))
   (turned :axis y :at (-0.0201 -0.0012) :color sun
         :line ((0 0.0274) (0.034 0.0274) (0.034 0.0292) (0 0.0292)))))

; The handle is round like a D.
(object mug
 :surfaces
  ((vessel)
   (tube :up (0 -1 0)
         :path (((0.0405 0 -0.046) 0.0062) ((0.056169 0 -0.044756) 0.0062)
                ((0.062279 0 -0.04111) 0.0062) ((0.0664 0 -0.035309) 0.0062)
                ((0.069163 0 -0.02775) 0.0062) ((0.070771 0 -0.018947) 0.0062)
                ((0.0713 0 -0.0095) 0.0062) ((0.070771 0 -0.000053) 0.0062)
                ((0.069163 0 0.00875) 0.0062) ((0.0664 0 0.016309) 0.0062)
                ((0.062279 0 0.02211) 0.0062) ((0.056169 0 0.025756) 0.0062)
                ((0.0405 0 0.027) 0.0062)))))

(object cup
 :surfaces
  ((vessel)
   (tube :up (0 -1 0)
         :path (((0.0345 0 -0.018) 0.0042) ((0.044319 0 -0.01725) 0.0042)
                ((0.048147 0 -0.015053) 0.0042) ((0.050729 0 -0.011556) 0.0042)
                ((0.052461 0 -0.007) 0.0042) ((0.053468 0 -0.001694) 0.0042)
                ((0.0538 0 0.004) 0.0042) ((0.053468 0 0.009694) 0.0042)
                ((0.052461 0 0.015) 0.0042) ((0.050729 0 0.019556) 0.0042)
                ((0.048147 0 0.023053) 0.0042) ((0.044319 0 0.02525) 0.0042)
                ((0.0345 0 0.026) 0.0042)))))

(object pot
 :surfaces
  ((vessel)
   (turned :axis z :color steel
         :line ((0.121 0.066) (0.127 0.067) (0.129 0.07) (0.127 0.073) (0.121 0.073)))
   (tube :up (0 0 1) :color ink
         :path (((0.042 -0.116 0.0575) 0.009) ((0.039944 -0.152689 0.0575) 0.009)
                ((0.033979 -0.1666 0.0575) 0.009) ((0.024687 -0.175364 0.0575) 0.009)
                ((0.012979 -0.180365 0.0575) 0.009) ((0 -0.182 0.0575) 0.009)
                ((-0.012979 -0.180365 0.0575) 0.009) ((-0.024687 -0.175364 0.0575) 0.009)
                ((-0.033979 -0.1666 0.0575) 0.009) ((-0.039944 -0.152689 0.0575) 0.009)
                ((-0.042 -0.116 0.0575) 0.009)))
   (tube :up (0 0 -1) :color ink
         :path (((0.042 0.116 0.0575) 0.009) ((0.039944 0.152689 0.0575) 0.009)
                ((0.033979 0.1666 0.0575) 0.009) ((0.024687 0.175364 0.0575) 0.009)
                ((0.012979 0.180365 0.0575) 0.009) ((0 0.182 0.0575) 0.009)
                ((-0.012979 0.180365 0.0575) 0.009) ((-0.024687 0.175364 0.0575) 0.009)
                ((-0.033979 0.1666 0.0575) 0.009) ((-0.039944 0.152689 0.0575) 0.009)
                ((-0.042 0.116 0.0575) 0.009)))))

; Lying, its long axis along x.
(object spoon
 :surfaces
  ((lofted :axis x
         :sections ((-0.1105 (0.008 0.0022) 0.0022)
                    (-0.095 (0.0082 0.0022) 0.0022)
                    (0 (0.0045 0.0022) 0.0022)
                    (0.056 (0.004 0.0024) 0.0024)))
   (lofted :axis x
         :sections ((0.053 (0.002 0.0022) 0.0022)
                    (0.054297 (0.006798 0.003003) 0.003003 (0 -0.001236))
                    (0.058061 (0.012931 0.003728) 0.003728 (0 -0.002351))
                    (0.063924 (0.017798 0.004303) 0.004303 (0 -0.003236))
                    (0.071311 (0.020923 0.004673) 0.004673 (0 -0.003804))
                    (0.0795 (0.022 0.0048) 0.0048 (0 -0.004))
                    (0.087689 (0.020923 0.004673) 0.004673 (0 -0.003804))
                    (0.095076 (0.017798 0.004303) 0.004303 (0 -0.003236))
                    (0.100939 (0.012931 0.003728) 0.003728 (0 -0.002351))
                    (0.104703 (0.006798 0.003003) 0.003003 (0 -0.001236))
                    (0.106 (0.002 0.0022) 0.0022 (0 0))))))

; Lying, its long axis along y.
(object fork
 :surfaces
  ((lofted :axis y
         :sections ((-0.0557 (0.002 0.0075) 0.002)
                    (-0.02 (0.002 0.0065) 0.002)
                    (0.045 (0.002 0.0036) 0.002)
                    (0.062 (0.002 0.0085) 0.002)
                    (0.072 (0.0018 0.0094) 0.0018)
                    (0.078 (0.0018 0.0094) 0.0018)))
   (lofted :axis y
         :sections ((0.076 (0.0016 0.0015) 0.0012 (0 -0.0078))
                    (0.1097 (0.0012 0.0008) 0.0008 (0.0005 -0.0078))))
   (lofted :axis y
         :sections ((0.076 (0.0016 0.0015) 0.0012 (0 -0.0026))
                    (0.1097 (0.0012 0.0008) 0.0008 (0.0005 -0.0026))))
   (lofted :axis y
         :sections ((0.076 (0.0016 0.0015) 0.0012 (0 0.0026))
                    (0.1097 (0.0012 0.0008) 0.0008 (0.0005 0.0026))))
   (lofted :axis y
         :sections ((0.076 (0.0016 0.0015) 0.0012 (0 0.0078))
                    (0.1097 (0.0012 0.0008) 0.0008 (0.0005 0.0078))))))

; Lying, its long axis along y.
(object knife
 :surfaces
  ((lofted :axis y :ends (0.003 0)
         :sections ((-0.0921 (0.0036 0.007) 0.003 (0 0.0014))
                    (-0.05 (0.004 0.0085) 0.0036 (0 0.0014))
                    (-0.004 (0.0034 0.007) 0.003 (0 0.0014))))
   (lofted :axis y :color steel
         :sections ((-0.006 (0.0012 0.0068) 0.001 (0 0.0014))
                    (0.04 (0.0011 0.009) 0.001 (0 0.0014))
                    (0.07 (0.001 0.0075) 0.001 (0 0.0022))
                    (0.0875 (0.0008 0.001) 0.0008 (0 0.007))))))

; Lying, its long axis along x.
(object spatula
 :surfaces
  ((lofted :axis x :ends (0.005 0)
         :sections ((-0.1625 (0.011 0.0065) 0.006 (0 -0.0027))
                    (-0.08 (0.012 0.0075) 0.007 (0 -0.0027))
                    (0 (0.006 0.005) 0.005 (0 -0.0027))
                    (0.075 (0.006 0.0035) 0.0035 (0 -0.0015))))
   (lofted :axis x
         :sections ((0.07 (0.012 0.0022) 0.002)
                    (0.09 (0.0235 0.002) 0.002 (0 0.001))
                    (0.1655 (0.0245 0.0014) 0.001 (0 0.004))))))

; Lying, slightly curved.
(object weisswurst
 :surfaces
  ((tube :up (0 0 1)
         :path (((-0.0545 -0.0113 0) 0.002234) ((-0.046714 -0.007453 0) 0.013301)
                ((-0.038929 -0.004198 0) 0.015255) ((-0.031143 -0.001535 0) 0.01571)
                ((-0.023357 0.000537 0) 0.015791) ((-0.015571 0.002016 0) 0.0158)
                ((-0.007786 0.002904 0) 0.0158) ((0 0.0032 0) 0.0158)
                ((0.007786 0.002904 0) 0.0158) ((0.015571 0.002016 0) 0.0158)
                ((0.023357 0.000537 0) 0.015791) ((0.031143 -0.001535 0) 0.01571)
                ((0.038929 -0.004198 0) 0.015255) ((0.046714 -0.007453 0) 0.013301)
                ((0.0545 -0.0113 0) 0.002234)))))

; A cap with its peak along -y.
(object cap
 :surfaces
  ((turned :axis z :at (0 0.0127)
         :line ((0 0.0005) (0.0436 0.0005) (0.0436 0.01) (0.042 0.022) (0.037 0.033)
                (0.027 0.041) (0.013 0.0442) (0 0.0446)))
   (lofted :axis y
         :sections ((-0.075 (0.002 0.022) 0.0018 (0.0045 0))
                    (-0.064 (0.0022 0.031) 0.002 (0.006 0))
                    (-0.035 (0.0022 0.035) 0.002 (0.008 0))
                    (-0.01 (0.0022 0.035) 0.002 (0.008 0))))))

; The kitchen.

; The rings of the stove, which hardly stand out from the glass; the glass ends at 2 mm.
(furniture kitchen_island_stove
 :surfaces
  ((turned :axis z :at (-0.115 -0.14) :color ring
         :line ((0.075 0.0023) (0.07 0.0023)))
   (turned :axis z :at (0.12 -0.14) :color ring
         :line ((0.1 0.0023) (0.095 0.0023)))
   (turned :axis z :at (-0.115 0.14) :color ring
         :line ((0.1 0.0023) (0.095 0.0023)))
   (turned :axis z :at (0.12 0.14) :color ring
         :line ((0.075 0.0023) (0.07 0.0023)))))

; The PR2: white covers with round edges over dark joints, sensors in the head, and shoulders and
; grippers coloured by side, blue on the left and orange on the right. The proportions are those
; of the boxes and cylinders of its model, which the covers fill and exceed by a few millimetres
; at most.

(link base_link :of pr2
 :surfaces
  ((lofted :axis z :ends (0.008 0.02) :color white
         :sections ((0.012 (0.322 0.322) 0.075)
                    (0.05 (0.334 0.334) 0.085)
                    (0.175 (0.334 0.334) 0.085)
                    (0.23 (0.326 0.326) 0.085)))
   (bar :axis z :span (-0.012 0.02) :half (0.312 0.312) :round 0.075 :color black)
   ; The laser of the base in its slot.
   (bar :axis x :span (0.25 0.3375) :at (0 0.188) :half (0.235 0.018) :round 0.012 :color black)
   (bar :axis z :span (0.228 0.238) :at (0.03 0) :half (0.245 0.25) :round 0.06 :color silver)
   (disc :axis z :span (0.225 0.27) :at (0.245 0) :radius 0.042 :color dark)
   (disc :axis z :span (0.27 0.295) :at (0.245 0) :radius 0.034 :color black)
   ; The battery box, and the column above it.
   (bar :axis z :span (0.228 0.325) :at (-0.262 0) :half (0.072 0.3) :round 0.035 :color white)
   (bar :axis z :span (0.32 0.656) :at (-0.2875 0) :half (0.047 0.232) :round 0.035 :color white)
   (bar :axis x :span (-0.3365 -0.325) :at (0 0.49) :half (0.165 0.115) :round 0.02 :color grey)))

; The bellows that hide the lift.
(link base_bellow_link :of pr2
 :surfaces
  ((lofted :axis z :color dark
         :sections ((-0.15 (0.017 0.177) 0.015)
                    (-0.135 (0.025 0.185) 0.015)
                    (-0.12 (0.017 0.177) 0.015)
                    (-0.105 (0.025 0.185) 0.015)
                    (-0.09 (0.017 0.177) 0.015)
                    (-0.075 (0.025 0.185) 0.015)
                    (-0.06 (0.017 0.177) 0.015)
                    (-0.045 (0.025 0.185) 0.015)
                    (-0.03 (0.017 0.177) 0.015)
                    (-0.015 (0.025 0.185) 0.015)
                    (0 (0.017 0.177) 0.015)
                    (0.015 (0.025 0.185) 0.015)
                    (0.03 (0.017 0.177) 0.015)
                    (0.045 (0.025 0.185) 0.015)
                    (0.06 (0.017 0.177) 0.015)
                    (0.075 (0.025 0.185) 0.015)
                    (0.09 (0.017 0.177) 0.015)
                    (0.105 (0.025 0.185) 0.015)
                    (0.12 (0.017 0.177) 0.015)
                    (0.135 (0.025 0.185) 0.015)
                    (0.15 (0.017 0.177) 0.015)))))

(link torso_lift_link :of pr2
 :surfaces
  ((lofted :axis z :ends (0.02 0) :color silver
         :sections ((-0.505 (0.09 0.158) 0.05 (-0.1145 0))
                    (-0.05 (0.0975 0.165) 0.05 (-0.1145 0))))
   (lofted :axis z :ends (0.015 0.03) :color white
         :sections ((-0.052 (0.118 0.185) 0.06 (-0.152 0))
                    (-0.005 (0.1355 0.2085) 0.06 (-0.152 0))
                    (0.135 (0.1355 0.2085) 0.06 (-0.152 0))
                    (0.175 (0.193 0.2095) 0.07 (-0.092 0))
                    (0.314 (0.2 0.2095) 0.08 (-0.088 0))))
   (bar :axis x :span (0.03 0.116) :at (0 0.236) :half (0.112 0.052) :round 0.03 :color black)
   (bar :axis x :span (-0.3 -0.285) :at (0 0.11) :half (0.13 0.14) :round 0.03 :color silver)
   (disc :axis x :span (-0.312 -0.299) :at (0.085 0.2) :radius 0.026 :color red)
   (disc :axis z :span (0.3 0.33) :at (-0.017 0) :radius 0.105 :color grey)))

; The tilting laser between the shoulders.
(link laser_tilt_mount_link :of pr2
 :surfaces
  ((disc :axis y :span (-0.0815 -0.045) :at (0.003 -0.003) :radius 0.04 :color grey)
   (disc :axis y :span (0.045 0.0815) :at (0.003 -0.003) :radius 0.04 :color grey)
   (bar :axis x :span (-0.045 0.052) :half (0.046 0.042) :round 0.02 :color dark)
   (disc :axis z :span (0.03 0.066) :at (0.012 0) :radius 0.03 :color black)))

(link head_pan_link :of pr2
 :surfaces
  ((disc :axis z :span (-0.085 -0.05) :radius 0.098 :color grey)
   (lofted :axis z :ends (0.012 0.02) :color silver
         :sections ((-0.066 (0.108 0.135) 0.06 (0.012 0))
                    (-0.03 (0.127 0.159) 0.065 (0.016 0))
                    (0.03 (0.127 0.159) 0.065 (0.016 0))
                    (0.0795 (0.095 0.159) 0.06 (0.03 0))))
   (disc :axis y :span (-0.164 -0.15) :at (0 0.068) :radius 0.05 :color grey)
   (disc :axis y :span (0.15 0.164) :at (0 0.068) :radius 0.05 :color grey)))

; The head: a flat box with the cameras in a dark plate across its front.
(link head_tilt_link :of pr2
 :surfaces
  ((lofted :axis x :ends (0.02 0.01) :color white
         :sections ((-0.183 (0.128 0.034) 0.03 (0 0.118))
                    (-0.12 (0.145 0.041) 0.035 (0 0.114))
                    (0.015 (0.147 0.0445) 0.035 (0 0.11))
                    (0.05 (0.147 0.054) 0.035 (0 0.101))
                    (0.079 (0.147 0.054) 0.035 (0 0.101))))
   (bar :axis x :span (0.07 0.0835) :at (0 0.108) :half (0.136 0.034) :round 0.024 :color black)
   ; The high-definition camera, two pairs of cameras, and the projector.
   (disc :axis x :span (0.078 0.0875) :at (-0.11 0.114) :radius 0.021 :color grey)
   (disc :axis x :span (0.08 0.0895) :at (-0.11 0.114) :radius 0.01428 :color (0.03 0.05 0.1))
   (disc :axis x :span (0.078 0.0875) :at (-0.06 0.114) :radius 0.013 :color grey)
   (disc :axis x :span (0.08 0.0895) :at (-0.06 0.114) :radius 0.00884 :color (0.1 0.13 0.2))
   (disc :axis x :span (0.078 0.0875) :at (-0.03 0.114) :radius 0.013 :color grey)
   (disc :axis x :span (0.08 0.0895) :at (-0.03 0.114) :radius 0.00884 :color (0.1 0.13 0.2))
   (disc :axis x :span (0.078 0.0875) :at (0.03 0.114) :radius 0.013 :color grey)
   (disc :axis x :span (0.08 0.0895) :at (0.03 0.114) :radius 0.00884 :color (0.1 0.13 0.2))
   (disc :axis x :span (0.078 0.0875) :at (0.06 0.114) :radius 0.013 :color grey)
   (disc :axis x :span (0.08 0.0895) :at (0.06 0.114) :radius 0.00884 :color (0.1 0.13 0.2))
   (disc :axis x :span (0.078 0.0875) :at (0.11 0.114) :radius 0.021 :color grey)
   (disc :axis x :span (0.08 0.0895) :at (0.11 0.114) :radius 0.01428 :color (0.45 0.05 0.03))))

(link l_shoulder_pan_link r_shoulder_pan_link :of pr2 :own (blue orange)
 :surfaces
  ((turned :axis z :color white
         :line ((0 -0.4915) (0.085 -0.4915) (0.104 -0.485) (0.112 -0.468) (0.116 -0.3)
                (0.131 -0.245) (0.131 -0.06)))
   (turned :axis z
         :line ((0.131 -0.062) (0.1318 -0.058) (0.1318 0.085) (0.126 0.112) (0.11 0.13)
                (0.085 0.14) (0 0.142)))
   (turned :axis z :color dark
         :line ((0.126 -0.068) (0.1325 -0.064) (0.1325 -0.058) (0.126 -0.054)))
   (disc :axis y :span (-0.127 -0.077) :at (0 0.098) :radius 0.134 :color white)
   (disc :axis y :span (-0.131 -0.123) :at (0 0.098) :radius 0.062 :color grey)
   (disc :axis y :span (0.077 0.127) :at (0 0.098) :radius 0.134 :color white)
   (disc :axis y :span (0.123 0.131) :at (0 0.098) :radius 0.062 :color grey)))

(link l_shoulder_lift_link r_shoulder_lift_link :of pr2
 :surfaces
  ((disc :axis y :span (-0.077 0.077) :radius 0.128 :color grey)
   (bar :axis x :span (0.03 0.122) :half (0.076 0.095) :round 0.06 :color grey)))

(link l_upper_arm_roll_link r_upper_arm_roll_link :of pr2
 :surfaces
  ((disc :axis x :span (0.119 0.1405) :radius 0.0725 :color dark)))

(link l_upper_arm_link r_upper_arm_link :of pr2 :own (blue orange)
 :surfaces
  ((lofted :axis x :ends (0.02 0.01) :color white
         :sections ((0.135 (0.0765 0.082) 0.06 (0 -0.004))
                    (0.24 (0.0765 0.082) 0.06 (0 -0.004))
                    (0.3 (0.068 0.07) 0.055 (0 -0.016))
                    (0.4 (0.0675 0.066) 0.05 (0 -0.0205))))
   (bar :axis x :span (0.158 0.172) :at (0 -0.004) :half (0.078 0.0835) :round 0.06)
   (disc :axis y :span (-0.0705 0.0705) :at (-0.0015 0.4) :radius 0.086 :color white)
   (disc :axis y :span (-0.0735 -0.066) :at (0 0.4) :radius 0.052 :color grey)
   (disc :axis y :span (0.066 0.0735) :at (0 0.4) :radius 0.052 :color grey)))

(link l_elbow_flex_link r_elbow_flex_link :of pr2
 :surfaces
  ((disc :axis y :span (-0.0195 0.0195) :radius 0.082 :color dark)
   (bar :axis x :span (0.04 0.0925) :at (0 -0.0035) :half (0.046 0.062) :round 0.035 :color dark)))

(link l_forearm_roll_link r_forearm_roll_link :of pr2
 :surfaces
  ((disc :axis x :span (0.086 0.1065) :radius 0.045 :color dark)))

(link l_forearm_link r_forearm_link :of pr2 :own (blue orange)
 :surfaces
  ((lofted :axis x :ends (0.014 0.012) :color white
         :sections ((0.096 (0.0605 0.0605) 0.05 (0 0.006))
                    (0.165 (0.0605 0.0605) 0.05 (0 0.006))
                    (0.225 (0.0605 0.051) 0.042 (0 0.001))
                    (0.3 (0.0595 0.0425) 0.036 (0 -0.006))
                    (0.355 (0.046 0.038) 0.03 (0 -0.006))))
   (bar :axis x :span (0.176 0.188) :at (0 0.0048) :half (0.0613 0.0602) :round 0.05)
   (bar :axis x :span (0.235 0.3) :at (0 0.036) :half (0.03 0.006) :round 0.005 :color dark)))

(link l_wrist_flex_link r_wrist_flex_link :of pr2
 :surfaces
  ((disc :axis y :span (-0.0215 0.0215) :radius 0.0385 :color dark)
   (bar :axis x :span (0 0.0275) :at (0 -0.003) :half (0.0215 0.032) :round 0.015 :color dark)))

(link l_gripper_palm_link r_gripper_palm_link :of pr2 :own (blue orange)
 :surfaces
  ((bar :axis x :span (0.026 0.062) :half (0.0265 0.0235) :round 0.012 :color silver)
   (disc :axis z :span (-0.0243 0.0243) :at (0.0785 0) :radius 0.0515)
   (disc :axis z :span (-0.0262 0.0262) :at (0.0785 0) :radius 0.03 :color grey)
   (bar :axis x :span (0.099 0.1255) :half (0.034 0.0235) :round 0.01 :color grey)))

(link l_gripper_l_finger_link r_gripper_l_finger_link :of pr2
 :surfaces
  ((lofted :axis x :ends (0.006 0.004) :color silver
         :sections ((-0.006 (0.016 0.021) 0.01 (0.012 0))
                    (0.018 (0.024 0.0265) 0.01 (0.021 0))
                    (0.055 (0.021 0.0235) 0.01 (0.02 0))
                    (0.0955 (0.0135 0.016) 0.01 (0.013 0))))
   (disc :axis z :span (-0.0282 0.0282) :radius 0.0115 :color dark)))

(link l_gripper_r_finger_link r_gripper_r_finger_link :of pr2
 :surfaces
  ((lofted :axis x :ends (0.006 0.004) :color silver
         :sections ((-0.006 (0.016 0.021) 0.01 (-0.012 0))
                    (0.018 (0.024 0.0265) 0.01 (-0.021 0))
                    (0.055 (0.021 0.0235) 0.01 (-0.02 0))
                    (0.0955 (0.0135 0.016) 0.01 (-0.013 0))))
   (disc :axis z :span (-0.0282 0.0282) :radius 0.0115 :color dark)))
