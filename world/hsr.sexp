; The roles of the HSR's links and joints, and how fast they may move. Units: m, rad, s. Names are those in
; world/hsr.urdf; world/pr2.sexp says what the records mean.

(robot HSR)

; Twin casters: the base drives in any direction. Its wheels would turn fast enough for 0.83 m/s.
(base :frame base_footprint :body base_link :drive omnidirectional
      :drive-velocity 0.5 :drive-acceleration 0.5
      :turn-velocity 1.0 :turn-acceleration 1.0)

; The torso has no lift of its own: it rises half as far as the arm. The head tilts about -y.
(neck :joints (head_pan_joint head_tilt_joint))

; 60 degrees wide.
(camera head
        :frame head_rgbd_sensor_link
        :width 320 :height 240 :vertical-view 0.8169
        :near 0.1 :far 10 :visible-share 0.9)

; Five joints: a lift, then pitch, roll, pitch and roll. The hand moves freely in the upright plane through
; the arm; the base turns towards what it grasps. Parked, the arm stands below the head, and the hand points
; to the left.
(arm right
     :base base_link
     :wrist hand_palm_link
     :tool hand_palm_link
     :tool-offset 0.075
     :tool-axes ((0 1 0) (-1 0 0) (0 0 1))
     :payload 1.2
     :start park
     :postures
     ((park 0.05 0 1.57 -1.57 0)
      (carry-top 0.6 -1.3 0 -1.84 0)
      (carry-side-gripper-vertical 0.05 0 1.57 -1.57 0)))

; One motor moves both fingers. The gap is measured.
(gripper right
         :palm hand_palm_link
         :joints (hand_motor_joint)
         :pad-size (0.045 0.03)
         :effort 40
         :left-finger (hand_r_proximal_link hand_r_distal_link)
         :right-finger (hand_l_proximal_link hand_l_distal_link))

(default-speed :velocity 1.5 :acceleration 4.0)
(speed arm_lift_joint :velocity 0.2 :acceleration 0.5)

(touching base_link torso_lift_link arm_lift_link)
(touching torso_lift_link head_pan_link head_tilt_link)
(touching arm_lift_link arm_flex_link)
(touching arm_flex_link arm_roll_link wrist_flex_link)
(touching wrist_flex_link wrist_roll_link)
(touching wrist_roll_link hand_palm_link)
(touching hand_palm_link hand_l_proximal_link hand_r_proximal_link)
(touching hand_l_proximal_link hand_l_distal_link hand_r_distal_link)
(touching hand_r_proximal_link hand_r_distal_link)

(wheels base_r_drive_wheel_link base_l_drive_wheel_link)
(idle-joints base_r_drive_wheel_joint base_l_drive_wheel_joint)

; By which actions of ROS 2 programs outside drive the robot. Time-outs and tolerances that are not given are as in CRAM's process
; modules of the PR2. The base is as CRAM's successor has it; the other names are those of controllers that offer the types of
; action that planwright uses. Not tried on the robot.
(interface base :name /hsrb/move_base :time-out 60 :tolerance 0.05 :turn-tolerance 0.1)
(interface neck :name /head_controller/point_head_action :time-out 5)
(interface right-arm :name /arm_trajectory_controller/follow_joint_trajectory :time-out 10 :tolerance 0.17)
(interface right-gripper :name /right_gripper_controller/gripper_cmd :time-out 10 :tolerance 0.003)
(interface map :name map :max-age 1)
(interface joint-states :names (/joint_states) :max-age 0.5)
(interface perception :name /detect_objects)
(interface server :time-out 10)
