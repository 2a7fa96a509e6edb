; How objects are grasped: the values of CRAM's object knowledge.
; Units: m, N. The frame of a grasp is the object's: front +x, left +y, top +z.
;
; A grasp gives the pose of a gripper frame (z forward, x across the palm) in the object's
; frame: :translation, and :rotation as the rows of a matrix or the name of one. The hand
; approaches through two pregrasps and leaves through two lifts, with the same rotation and
; with these offsets added to :translation, along the object's axes. :opening is how wide (m) the
; hand opens beforehand, if not as for other grasps of the type.

; The tool point is 0.2 m beyond the wrist, where the pads of closed fingers end. The fingers
; move on arcs: the pads lie 0 to 37 mm behind the tool point around something thin, and 10 to
; 46 mm around something 70 mm wide. The widest gap is 92 mm.

; Rotations by name. The first column is the direction in which the fingers close; the third column is the direction in which the hand approaches.
(rotation back ((0 0 1) (1 0 0) (0 1 0)))
(rotation front ((0 0 -1) (-1 0 0) (0 1 0)))
(rotation left-side ((1 0 0) (0 0 -1) (0 1 0)))
(rotation right-side ((-1 0 0) (0 0 1) (0 1 0)))
; From above, with the palm across x (the fingers close along y) or across y (along x).
(rotation top-across-x ((0 1 0) (1 0 0) (0 0 -1)))
(rotation top-across-y ((1 0 0) (0 -1 0) (0 0 -1)))
; The rim of a plate, from its left or right, 30 degrees off the vertical.
(rotation left-rim ((0 1 0) (0.5 0 -0.8660254037844386) (-0.8660254037844386 0 -0.5)))
(rotation right-rim ((0 -1 0) (-0.5 0 0.8660254037844386) (-0.8660254037844386 0 -0.5)))
; From above a side, 45 degrees off the vertical.
(rotation above-back ((0 0.7071067811865476 0.7071067811865476) (1 0 0) (0 0.7071067811865476 -0.7071067811865476)))
(rotation above-front ((0 -0.7071067811865476 -0.7071067811865476) (-1 0 0) (0 0.7071067811865476 -0.7071067811865476)))
(rotation above-left ((1 0 0) (0 -0.7071067811865476 -0.7071067811865476) (0 0.7071067811865476 -0.7071067811865476)))
(rotation above-right ((-1 0 0) (0 0.7071067811865476 0.7071067811865476) (0 0.7071067811865476 -0.7071067811865476)))
; From a side, with one finger above and one below.
(rotation flat-from-back ((0 0 1) (0 1 0) (-1 0 0)))
(rotation flat-from-front ((0 0 -1) (0 -1 0) (-1 0 0)))
(rotation flat-from-left ((0 1 0) (0 0 -1) (-1 0 0)))
(rotation flat-from-right ((0 -1 0) (0 0 1) (-1 0 0)))

; How hard to grip (N) and how wide to open the gripper beforehand (m).
(default-grip :effort 35 :opening 0.1)
(grip (cutlery spoon fork knife) :effort 100 :opening 0.04)
; CRAM opens to 0.02 m for plates and trays, too little for a rim from above.
(grip (plate tray) :effort 100 :opening 0.06)
(grip (bottle) :effort 60 :opening 0.1)
(grip (cup) :effort 50 :opening 0.1)
(grip (milk cereal) :effort 15 :opening 0.1)
(grip (breakfast-cereal) :effort 20 :opening 0.1)
(grip (bowl) :effort 100 :opening 0.1)
(grip (red-metal-plate blue-metal-plate tray-base pot open-box) :effort 100 :opening 0.06)
(grip (cube buttermilk mondamin sugar-box cereal-box) :effort 40 :opening 0.1)
(grip (mug) :effort 30 :opening 0.109)
(grip (apple) :effort 50 :opening 0.109)
(grip (orange) :effort 30 :opening 0.109)
(grip (shoe) :effort 40 :opening 0.1)
(grip (sponge) :effort 60 :opening 0.1)
(grip (salt-shaker) :effort 60 :opening 0.08)
(grip (big-knife whisk ladle) :effort 100 :opening 0.06)
(grip (bread-slice weisswurst-slice apple-slice orange-slice) :effort 20 :opening 0.06)
(grip (cap glasses glove) :effort 30 :opening 0.1)
(grip (weisswurst spatula visualization-box) :effort 30 :opening 0.07)

; The grasps to try, in this order, if none is asked for.
(order (bottle) left-side right-side back front)
(order (cup) back front left-side right-side)
(order (milk) back left-side right-side front)
(order (cereal breakfast-cereal) back front)
(order (plate) left-side right-side top top-front top-left top-right)
(order (red-metal-plate blue-metal-plate) top top-front top-left top-right)
(order (tray) left-side right-side top top-front top-left top-right)
(order (tray-base) front back left-side right-side)
(order (bowl cutlery spoon fork knife spatula weisswurst glasses glove cap) top)
(order (salt-shaker) back front left-side right-side)
(order (sponge big-knife whisk ladle bread-slice weisswurst-slice apple-slice orange-slice) top)
(order (cube) top top2 back front left-side right-side)
(order (buttermilk) left-side right-side back front top)
(order (mug) back front top top-left top-right)
(order (mondamin) back front top)
(order (pot) left-side right-side top top-front)
(order (shoe) top left-side right-side)
(order (orange apple) top back front left-side right-side)
(order (sugar-box) left-side right-side top)
(order (cereal-box) left-side right-side top)
(order (open-box) top top-front top-left top-right)
(order (visualization-box) top)

(grasp top :types (cutlery spoon) :arms (left right)
       :translation (0 0 0) :rotation top-across-x
       :pregrasp (0 0 0.2) :second-pregrasp (0 0 0.2)
       :lift (0 0 0.2) :second-lift (0 0 0.2))
; Nearer to the ends, for where something is in the way of the hand in the middle.
(grasp top-back :types (cutlery spoon) :arms (left right)
       :translation (-0.06 0 0) :rotation top-across-x
       :pregrasp (0 0 0.2) :second-pregrasp (0 0 0.2)
       :lift (0 0 0.2) :second-lift (0 0 0.2))
(grasp top-front :types (cutlery spoon) :arms (left right)
       :translation (0.035 0 0) :rotation top-across-x
       :pregrasp (0 0 0.2) :second-pregrasp (0 0 0.2)
       :lift (0 0 0.2) :second-lift (0 0 0.2))
; CRAM's forks and knives lie along x, these along y.
(grasp top :types (fork knife) :arms (left right)
       :translation (0 0 0) :rotation top-across-y
       :pregrasp (0 0 0.2) :second-pregrasp (0 0 0.2)
       :lift (0 0 0.2) :second-lift (0 0 0.2))

(grasp left-side :types (plate tray) :arms (left)
       :translation (0 0.115 0.015) :rotation left-rim
       :pregrasp (0 0.2 0.15) :second-pregrasp (0 0.2 0.03)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp right-side :types (plate) :arms (right)
       :translation (0 -0.115 0.015) :rotation right-rim
       :pregrasp (0 -0.2 0.15) :second-pregrasp (0 -0.2 0.03)
       :lift (0 0 0.15) :second-lift (0 0 0.15))

; The tool goes 2 cm beyond the axis of the bottle.
(grasp left-side :types (drink bottle) :arms (left right)
       :translation (0 -0.02 0.005) :rotation left-side
       :pregrasp (0 0.15 0.15) :second-pregrasp (0 0.15 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp right-side :types (drink bottle) :arms (left right)
       :translation (0 0.02 0.005) :rotation right-side
       :pregrasp (0 -0.15 0.15) :second-pregrasp (0 -0.15 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp back :types (drink bottle) :arms (left right)
       :translation (0.02 0 0.005) :rotation back
       :pregrasp (-0.15 0 0.15) :second-pregrasp (-0.15 0 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
; CRAM gives front the offsets of back, so that the hand would come from behind, through
; the bottle, palm first. The offsets here mirror those of back instead.
(grasp front :types (drink bottle) :arms (left right)
       :translation (-0.02 0 0.005) :rotation front
       :pregrasp (0.15 0 0.15) :second-pregrasp (0.15 0 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))

(grasp top :types (cup) :arms (left right)
       :translation (-0.03 0 0.02) :rotation top-across-y
       :pregrasp (0 0 0.15) :second-pregrasp (0 0 0.15)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp left-side :types (cup) :arms (left right)
       :translation (0 -0.02 0.03) :rotation left-side
       :pregrasp (0 0.15 0.15) :second-pregrasp (0 0.15 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp right-side :types (cup) :arms (left right)
       :translation (0 0.02 0.03) :rotation right-side
       :pregrasp (0 -0.15 0.15) :second-pregrasp (0 -0.15 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp back :types (cup) :arms (left right)
       :translation (0.02 0 0.03) :rotation back
       :pregrasp (-0.15 0 0.15) :second-pregrasp (-0.15 0 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp front :types (cup) :arms (left right)
       :translation (-0.02 0 0.03) :rotation front
       :pregrasp (0.15 0 0.15) :second-pregrasp (0.15 0 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))

(grasp left-side :types (milk) :arms (left right)
       :translation (0 -0.01 0) :rotation left-side
       :pregrasp (0 0.15 0.15) :second-pregrasp (0 0.15 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp right-side :types (milk) :arms (left right)
       :translation (0 0.01 0) :rotation right-side
       :pregrasp (0 -0.15 0.15) :second-pregrasp (0 -0.15 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp back :types (milk) :arms (left right)
       :translation (0.01 0 0) :rotation back
       :pregrasp (-0.15 0 0.15) :second-pregrasp (-0.15 0 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp front :types (milk) :arms (left right)
       :translation (-0.01 0 0) :rotation front
       :pregrasp (0.15 0 0.15) :second-pregrasp (0.15 0 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))

(grasp top :types (cereal breakfast-cereal) :arms (left right)
       :translation (0 0 0.04) :rotation top-across-x
       :pregrasp (0 0 0.15) :second-pregrasp (0 0 0.15)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp back :types (cereal breakfast-cereal) :arms (left right)
       :translation (-0.03 0 0.04) :rotation back
       :pregrasp (-0.15 0 0.15) :second-pregrasp (-0.15 0 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp front :types (cereal breakfast-cereal) :arms (left right)
       :translation (0.03 0 0.04) :rotation front
       :pregrasp (0.15 0 0.15) :second-pregrasp (0.15 0 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))

(grasp top :types (bowl) :arms (left right)
       :translation (-0.07 0 0.01) :rotation top-across-y
       :pregrasp (0 0 0.2) :second-pregrasp (0 0 0.2)
       :lift (0 0 0.2) :second-lift (0 0 0.2))

; Grasps that CRAM does not have, for the shapes of world/objects.sexp.

; The other sides of a bowl's rim, from less high above: 0.2 m above a counter of 0.9 m, a hand that points
; downwards is out of a PR2's reach.
(grasp top-front :types (bowl) :arms (left right)
       :translation (0.07 0 0.01) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-left :types (bowl) :arms (left right)
       :translation (0 0.07 0.01) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-right :types (bowl) :arms (left right)
       :translation (0 -0.07 0.01) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))

; The rims of plates, one finger inside and one outside.
(grasp top :types (plate) :arms (left right)
       :translation (-0.1155 0 0.0085) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-front :types (plate) :arms (left right)
       :translation (0.1155 0 0.0085) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-left :types (plate) :arms (left right)
       :translation (0 0.1155 0.0085) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-right :types (plate) :arms (left right)
       :translation (0 -0.1155 0.0085) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top :types (red-metal-plate) :arms (left right)
       :translation (-0.1183 0 0.0012) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-front :types (red-metal-plate) :arms (left right)
       :translation (0.1183 0 0.0012) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-left :types (red-metal-plate) :arms (left right)
       :translation (0 0.1183 0.0012) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-right :types (red-metal-plate) :arms (left right)
       :translation (0 -0.1183 0.0012) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top :types (blue-metal-plate) :arms (left right)
       :translation (-0.0937 0 0.003) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-front :types (blue-metal-plate) :arms (left right)
       :translation (0.0937 0 0.003) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-left :types (blue-metal-plate) :arms (left right)
       :translation (0 0.0937 0.003) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-right :types (blue-metal-plate) :arms (left right)
       :translation (0 -0.0937 0.003) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
; The walls of the tray.
(grasp top :types (tray) :arms (left right)
       :translation (-0.2102 0 0.012) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-front :types (tray) :arms (left right)
       :translation (0.2102 0 0.012) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-left :types (tray) :arms (left right)
       :translation (0 0.1755 0.012) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-right :types (tray) :arms (left right)
       :translation (0 -0.1755 0.012) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
; Beside the middles of its walls: for two hands at opposite corners, where things stand in the middle.
(grasp top-back-left :types (tray) :arms (left right)
       :translation (-0.2102 0.1 0.012) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-back-right :types (tray) :arms (left right)
       :translation (-0.2102 -0.1 0.012) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-front-left :types (tray) :arms (left right)
       :translation (0.2102 0.1 0.012) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-front-right :types (tray) :arms (left right)
       :translation (0.2102 -0.1 0.012) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-left-back :types (tray) :arms (left right)
       :translation (-0.11 0.1755 0.012) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-left-front :types (tray) :arms (left right)
       :translation (0.11 0.1755 0.012) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-right-back :types (tray) :arms (left right)
       :translation (-0.11 -0.1755 0.012) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-right-front :types (tray) :arms (left right)
       :translation (0.11 -0.1755 0.012) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
; Between these, and nearer to the corners: where things stand along the walls, too.
(grasp top-back-left-near-middle :types (tray) :arms (left right)
       :translation (-0.2102 0.05 0.012) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-back-left-near-corner :types (tray) :arms (left right)
       :translation (-0.2102 0.145 0.012) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-back-right-near-middle :types (tray) :arms (left right)
       :translation (-0.2102 -0.05 0.012) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-back-right-near-corner :types (tray) :arms (left right)
       :translation (-0.2102 -0.145 0.012) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-front-left-near-middle :types (tray) :arms (left right)
       :translation (0.2102 0.05 0.012) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-front-left-near-corner :types (tray) :arms (left right)
       :translation (0.2102 0.145 0.012) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-front-right-near-middle :types (tray) :arms (left right)
       :translation (0.2102 -0.05 0.012) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-front-right-near-corner :types (tray) :arms (left right)
       :translation (0.2102 -0.145 0.012) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-left-back-near-middle :types (tray) :arms (left right)
       :translation (-0.055 0.1755 0.012) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-left-back-near-corner :types (tray) :arms (left right)
       :translation (-0.16 0.1755 0.012) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-left-front-near-middle :types (tray) :arms (left right)
       :translation (0.055 0.1755 0.012) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-left-front-near-corner :types (tray) :arms (left right)
       :translation (0.16 0.1755 0.012) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-right-back-near-middle :types (tray) :arms (left right)
       :translation (-0.055 -0.1755 0.012) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-right-back-near-corner :types (tray) :arms (left right)
       :translation (-0.16 -0.1755 0.012) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-right-front-near-middle :types (tray) :arms (left right)
       :translation (0.055 -0.1755 0.012) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-right-front-near-corner :types (tray) :arms (left right)
       :translation (0.16 -0.1755 0.012) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
; Flat and too wide for anything else: where an edge stands out over what carries it.
(grasp front :types (tray-base) :arms (left right)
       :translation (0.08 0 0.0116) :rotation flat-from-front
       :pregrasp (0.1 0 0) :second-pregrasp (0.1 0 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp back :types (tray-base) :arms (left right)
       :translation (-0.08 0 0.0116) :rotation flat-from-back
       :pregrasp (-0.1 0 0) :second-pregrasp (-0.1 0 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp left-side :types (tray-base) :arms (left right)
       :translation (0 0.08 0.0116) :rotation flat-from-left
       :pregrasp (0 0.1 0) :second-pregrasp (0 0.1 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp right-side :types (tray-base) :arms (left right)
       :translation (0 -0.08 0.0116) :rotation flat-from-right
       :pregrasp (0 -0.1 0) :second-pregrasp (0 -0.1 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp top :types (cube) :arms (left right)
       :translation (0 0 -0.015) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top2 :types (cube) :arms (left right)
       :translation (0 0 -0.015) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp back :types (cube) :arms (left right)
       :translation (0.02 0 0.015) :rotation back
       :pregrasp (-0.15 0 0.15) :second-pregrasp (-0.15 0 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp front :types (cube) :arms (left right)
       :translation (-0.02 0 0.015) :rotation front
       :pregrasp (0.15 0 0.15) :second-pregrasp (0.15 0 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp left-side :types (cube) :arms (left right)
       :translation (0 -0.02 0.015) :rotation left-side
       :pregrasp (0 0.15 0.15) :second-pregrasp (0 0.15 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp right-side :types (cube) :arms (left right)
       :translation (0 0.02 0.015) :rotation right-side
       :pregrasp (0 -0.15 0.15) :second-pregrasp (0 -0.15 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp left-side :types (buttermilk) :arms (left right)
       :translation (0 -0.02 -0.01) :rotation left-side
       :pregrasp (0 0.15 0.15) :second-pregrasp (0 0.15 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp right-side :types (buttermilk) :arms (left right)
       :translation (0 0.02 -0.01) :rotation right-side
       :pregrasp (0 -0.15 0.15) :second-pregrasp (0 -0.15 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp back :types (buttermilk) :arms (left right)
       :translation (0.02 0 -0.01) :rotation back
       :pregrasp (-0.15 0 0.15) :second-pregrasp (-0.15 0 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp front :types (buttermilk) :arms (left right)
       :translation (-0.02 0 -0.01) :rotation front
       :pregrasp (0.15 0 0.15) :second-pregrasp (0.15 0 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
; By its neck.
(grasp top :types (buttermilk) :arms (left right)
       :translation (0 0 0.06) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
; Around the mug, its handle away from the hand; by the handle; by the rim. The tips of the fingers
; come forward as they close, and would push the rim down if they had been opened wide.
(grasp back :types (mug) :arms (left right)
       :translation (0.02 0 0.01) :rotation back
       :pregrasp (-0.15 0 0.15) :second-pregrasp (-0.15 0 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp front :types (mug) :arms (left right)
       :translation (0.05 0 -0.005) :rotation front
       :pregrasp (0.15 0 0.15) :second-pregrasp (0.15 0 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp top :types (mug) :arms (left right)
       :translation (-0.0383 0 0.015) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1) :opening 0.04)
(grasp top-left :types (mug) :arms (left right)
       :translation (0 0.0383 0.015) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1) :opening 0.04)
(grasp top-right :types (mug) :arms (left right)
       :translation (0 -0.0383 0.015) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1) :opening 0.04)
(grasp back :types (mondamin) :arms (left right)
       :translation (0 0 0) :rotation back
       :pregrasp (-0.15 0 0.15) :second-pregrasp (-0.15 0 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp front :types (mondamin) :arms (left right)
       :translation (0 0 0) :rotation front
       :pregrasp (0.15 0 0.15) :second-pregrasp (0.15 0 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
; By its cap.
(grasp top :types (mondamin) :arms (left right)
       :translation (0 0 0.089) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
; By the handles; by the rim.
(grasp left-side :types (pot) :arms (left right)
       :translation (0 0.145 0.0575) :rotation flat-from-left
       :pregrasp (0 0.15 0.15) :second-pregrasp (0 0.15 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp right-side :types (pot) :arms (left right)
       :translation (0 -0.145 0.0575) :rotation flat-from-right
       :pregrasp (0 -0.15 0.15) :second-pregrasp (0 -0.15 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp top :types (pot) :arms (left right)
       :translation (-0.1225 0 0.045) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-front :types (pot) :arms (left right)
       :translation (0.1225 0 0.045) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top :types (weisswurst) :arms (left right)
       :translation (0 0.0012 -0.01) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top :types (spatula) :arms (left right)
       :translation (0 0 -0.004) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
; By its upper half, so that the fingers stay away from what is wiped.
(grasp top :types (sponge) :arms (left right)
       :translation (0 0 0.005) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top :types (big-knife) :arms (left right)
       :translation (0 -0.035 -0.004) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
; Around its upper half: turned down, it is near what is salted, and upright, the arm is above the edge of a counter.
(grasp back :types (salt-shaker) :arms (left right)
       :translation (0.015 0 0.012) :rotation back
       :pregrasp (-0.15 0 0.1) :second-pregrasp (-0.15 0 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp front :types (salt-shaker) :arms (left right)
       :translation (-0.015 0 0.012) :rotation front
       :pregrasp (0.15 0 0.1) :second-pregrasp (0.15 0 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp left-side :types (salt-shaker) :arms (left right)
       :translation (0 -0.015 0.012) :rotation left-side
       :pregrasp (0 0.15 0.1) :second-pregrasp (0 0.15 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp right-side :types (salt-shaker) :arms (left right)
       :translation (0 0.015 0.012) :rotation right-side
       :pregrasp (0 -0.15 0.1) :second-pregrasp (0 -0.15 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp top :types (ladle) :arms (left right)
       :translation (0 -0.05 0.006) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top :types (whisk) :arms (left right)
       :translation (0 -0.03 -0.002) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top :types (bread-slice weisswurst-slice apple-slice orange-slice) :arms (left right)
       :translation (0 0 0) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
; By its visor; the cap itself is too wide.
(grasp top :types (cap) :arms (left right)
       :translation (0 -0.0565 -0.005) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top :types (glasses) :arms (left right)
       :translation (0 0.0006 -0.002) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top :types (glove) :arms (left right)
       :translation (0.0099 0.0005 0.002) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
; By its heel.
(grasp top :types (shoe) :arms (left right)
       :translation (0 0.0039 0.045) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp left-side :types (shoe) :arms (left right)
       :translation (0 0 0.07) :rotation left-side
       :pregrasp (0 0.15 0.15) :second-pregrasp (0 0.15 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp right-side :types (shoe) :arms (left right)
       :translation (0 0.015 0.08) :rotation right-side
       :pregrasp (0 -0.15 0.15) :second-pregrasp (0 -0.15 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp top :types (orange) :arms (left right)
       :translation (0 0 -0.025) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top :types (apple) :arms (left right)
       :translation (0 0 -0.025) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp back :types (orange apple) :arms (left right)
       :translation (0.02 0 0) :rotation back
       :pregrasp (-0.15 0 0.15) :second-pregrasp (-0.15 0 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp front :types (orange apple) :arms (left right)
       :translation (-0.02 0 0) :rotation front
       :pregrasp (0.15 0 0.15) :second-pregrasp (0.15 0 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp left-side :types (orange apple) :arms (left right)
       :translation (0 -0.02 0) :rotation left-side
       :pregrasp (0 0.15 0.15) :second-pregrasp (0 0.15 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp right-side :types (orange apple) :arms (left right)
       :translation (0 0.02 0) :rotation right-side
       :pregrasp (0 -0.15 0.15) :second-pregrasp (0 -0.15 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp left-side :types (sugar-box) :arms (left right)
       :translation (0 0 0) :rotation left-side
       :pregrasp (0 0.15 0.15) :second-pregrasp (0 0.15 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp right-side :types (sugar-box) :arms (left right)
       :translation (0 0 0) :rotation right-side
       :pregrasp (0 -0.15 0.15) :second-pregrasp (0 -0.15 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp top :types (sugar-box) :arms (left right)
       :translation (0 0 0.06) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp left-side :types (cereal-box) :arms (left right)
       :translation (0 0.045 0) :rotation left-side
       :pregrasp (0 0.15 0.15) :second-pregrasp (0 0.15 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp right-side :types (cereal-box) :arms (left right)
       :translation (0 -0.045 0) :rotation right-side
       :pregrasp (0 -0.15 0.15) :second-pregrasp (0 -0.15 0)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp top :types (cereal-box) :arms (left right)
       :translation (0 0 0.09) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top :types (open-box) :arms (left right)
       :translation (-0.245 0 0.06) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-front :types (open-box) :arms (left right)
       :translation (0.245 0 0.06) :rotation top-across-y
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-left :types (open-box) :arms (left right)
       :translation (0 0.245 0.06) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top-right :types (open-box) :arms (left right)
       :translation (0 -0.245 0.06) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
(grasp top :types (visualization-box) :arms (left right)
       :translation (0 0 -0.004) :rotation top-across-x
       :pregrasp (0 0 0.1) :second-pregrasp (0 0 0.1)
       :lift (0 0 0.1) :second-lift (0 0 0.1))
; A beaker from above, with the fingers around it: for drawers. CRAM's grasp of its rim, with one
; finger inside, needs a wider beaker. It is not listed above, so it is tried only if it is asked for.
(grasp top-around :types (cup) :arms (left right)
       :translation (0 0 0.01) :rotation top-across-y
       :pregrasp (0 0 0.15) :second-pregrasp (0 0 0.15)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp top-around-left :types (cup) :arms (left right)
       :translation (0 0 0.01) :rotation top-across-x
       :pregrasp (0 0 0.15) :second-pregrasp (0 0 0.15)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
; The same from less high above, as for bowls.
(grasp top-around-low :types (cup) :arms (left right)
       :translation (0 0 0.01) :rotation top-across-y
       :pregrasp (0 0 0.08) :second-pregrasp (0 0 0.08)
       :lift (0 0 0.08) :second-lift (0 0 0.08))
(grasp top-around-left-low :types (cup) :arms (left right)
       :translation (0 0 0.01) :rotation top-across-x
       :pregrasp (0 0 0.08) :second-pregrasp (0 0 0.08)
       :lift (0 0 0.08) :second-lift (0 0 0.08))
; A carton from above a side, over its upper edge: where a hand has no room beside it.
(grasp back-above :types (milk) :arms (left right)
       :translation (0 0 0.06) :rotation above-back
       :pregrasp (-0.1 0 0.1) :second-pregrasp (-0.1 0 0.1)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp left-side-above :types (milk) :arms (left right)
       :translation (0 0 0.06) :rotation above-left
       :pregrasp (0 0.1 0.1) :second-pregrasp (0 0.1 0.1)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp right-side-above :types (milk) :arms (left right)
       :translation (0 0 0.06) :rotation above-right
       :pregrasp (0 -0.1 0.1) :second-pregrasp (0 -0.1 0.1)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
(grasp front-above :types (milk) :arms (left right)
       :translation (0 0 0.06) :rotation above-front
       :pregrasp (0.1 0 0.1) :second-pregrasp (0.1 0 0.1)
       :lift (0 0 0.15) :second-lift (0 0 0.15))
