; The roles of Fetch's links and joints, and how fast they may move. Units: m, rad, s. Names are those in
; world/fetch.urdf; world/pr2.sexp says what the records mean.

(robot Fetch)

; The root lies on the floor. Two wheels beside it: the base drives forwards and backwards and turns.
(base :frame base_link :body base_link :drive differential
      :drive-velocity 1.0 :drive-acceleration 1.0
      :turn-velocity 1.5 :turn-acceleration 1.5)

(torso :link torso_lift_link :joint torso_lift_joint :start 0.15)

(neck :pan-joint head_pan_joint :pan-link head_pan_link
      :tilt-joint head_tilt_joint :tilt-link head_tilt_link)

; Plans may call the frame on the floor as the PR2 does.
(alias base_footprint base_link)

; 0.7853981633974483 rad is 45 degrees.
(camera head
        :frame head_camera_rgb_optical_frame
        :width 320 :height 240 :vertical-view 0.7853981633974483
        :near 0.1 :far 10 :visible-share 0.9)

; The maker's tuck stays within the base's radius, but there is no room for a thing in the hand. The other
; postures hold the hand before the torso.
; The frame of the tool is in the middle of the pads; grasps place what is 19 mm ahead of it.
(arm right
     :base torso_lift_link
     :wrist wrist_roll_link
     :tool gripper_link
     :tool-offset 0.185
     :tool-axes ((0 1 0) (0 0 1) (1 0 0))
     :payload 6
     :start tucked
     :postures
     ((tucked 1.32 1.40 -0.2 1.72 0.0 1.66 0.0)
      (park 1.4388 1.4149 -0.0575 2.1741 -1.3594 1.9996 -1.0748)
      (carry-top -0.9586 -0.8466 1.843 2.0795 -0.711 1.3599 1.1473)
      (carry-side-gripper-vertical 1.4388 1.4149 -0.0575 2.1741 -1.3594 1.9996 -1.0748)))

; Each finger has a joint of its own; both move by the same way. The gap is measured.
(gripper right
         :palm gripper_link
         :joints (r_gripper_finger_joint l_gripper_finger_joint)
         :pad-size (0.06 0.026)
         :effort 60
         :left-finger (r_gripper_finger_link)
         :right-finger (l_gripper_finger_link))

(default-speed :velocity 1.5 :acceleration 4.0)
(speed torso_lift_joint :velocity 0.1 :acceleration 0.4)

; Neighbours, and the fingers, whose pads press on each other by 0.6 mm when they are closed.
(touching base_link torso_fixed_link torso_lift_link)
(touching torso_lift_link head_pan_link)
(touching torso_lift_link shoulder_pan_link)
(touching head_pan_link head_tilt_link)
(touching shoulder_pan_link shoulder_lift_link)
(touching shoulder_lift_link upperarm_roll_link)
(touching upperarm_roll_link elbow_flex_link)
(touching elbow_flex_link forearm_roll_link)
(touching forearm_roll_link wrist_flex_link)
(touching wrist_flex_link wrist_roll_link)
(touching wrist_roll_link gripper_link)
(touching gripper_link r_gripper_finger_link l_gripper_finger_link)

(wheels r_wheel_link l_wheel_link)
(idle-joints r_wheel_joint l_wheel_joint)
