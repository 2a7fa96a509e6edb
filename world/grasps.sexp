; How objects are grasped: the values of CRAM's object knowledge.
; Units: m, N. The frame of a grasp is the object's: front +x, left +y, top +z.
;
; A grasp gives the pose of a gripper frame (z forward, x across the palm) in the object's
; frame: :translation, and :rotation as the rows of a matrix or the name of one. The hand
; approaches through two pregrasps and leaves through two lifts, with the same rotation and
; with these offsets added to :translation, along the object's axes.

; Rotations by name. The third column is the direction in which the hand approaches.
(rotation back ((0 0 1) (1 0 0) (0 1 0)))
(rotation front ((0 0 -1) (-1 0 0) (0 1 0)))
(rotation left-side ((1 0 0) (0 0 -1) (0 1 0)))
(rotation right-side ((-1 0 0) (0 0 1) (0 1 0)))
; From above, with the fingers across x or across y.
(rotation top-across-x ((0 1 0) (1 0 0) (0 0 -1)))
(rotation top-across-y ((1 0 0) (0 -1 0) (0 0 -1)))
; The rim of a plate, from its left or right, 30 degrees off the vertical.
(rotation left-rim ((0 1 0) (0.5 0 -0.8660254037844386) (-0.8660254037844386 0 -0.5)))
(rotation right-rim ((0 -1 0) (-0.5 0 0.8660254037844386) (-0.8660254037844386 0 -0.5)))

; How hard to grip (N) and how wide to open the gripper beforehand (m).
(default-grip :effort 35 :opening 0.1)
(grip (cutlery spoon fork knife) :effort 100 :opening 0.04)
(grip (plate tray) :effort 100 :opening 0.02)
(grip (bottle) :effort 60 :opening 0.1)
(grip (cup) :effort 50 :opening 0.1)
(grip (milk cereal) :effort 15 :opening 0.1)
(grip (breakfast-cereal) :effort 20 :opening 0.1)
(grip (bowl) :effort 100 :opening 0.1)

; The grasps to try, in this order, if none is asked for.
(order (bottle) left-side right-side back front)
(order (cup) back front left-side right-side)
(order (milk) back left-side right-side front)
(order (cereal breakfast-cereal) back front)
(order (plate tray) left-side right-side)
(order (bowl cutlery spoon fork knife) top)

(grasp top :types (cutlery spoon fork knife) :arms (left right)
       :translation (0 0 0) :rotation top-across-x
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
